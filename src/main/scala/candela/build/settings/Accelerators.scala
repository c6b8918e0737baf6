package candela.build.settings

import candela.accel.{Accelerator, Primitives}
import candela.accel.tracing.{Grid, Hierarchies}
import candela.build.recipe.*

/** Recipes of accelerators: the picture is the same with each. */
object Accelerators:
  val all: Recipes[Primitives => Accelerator] =
    Recipes("accelerator", Vector(BvhRecipe, GridRecipe, KdTreeRecipe))

object BvhRecipe
    extends Recipe[Primitives => Accelerator]("bvh", "a hierarchy of boxes"):
  noMeaning("Candela's own hierarchy is built")(
    string("splitmethod", "how it is split: sah, hlbvh, middle, equal")("sah"),
    integer("maxnodeprims", "most primitives in a leaf")(4)
  )
  protected def make()(using site: Site): Primitives => Accelerator =
    accelerator(site.resources)

  /** What every scene gets that doesn't ask for another. */
  def accelerator(resources: Resources): Primitives => Accelerator =
    Hierarchies.of(_, resources.crew)

object GridRecipe
    extends Recipe[Primitives => Accelerator]("grid", "cells of equal size", onlyV2):
  noMeaning("all shapes are refined beforehand")(
    bool("refineimmediately", "refine all shapes when the grid is built")(false)
  )
  protected def make()(using Site): Primitives => Accelerator = Grid(_)

object KdTreeRecipe
    extends Recipe[Primitives => Accelerator]("kdtree", "space, split again and again"):
  override def pending: Option[String] = Some("a bvh is used, with the same picture")
  declare(
    integer("intersectcost", "of a primitive, for splitting")(if v4 then 5 else 80),
    integer("traversalcost", "of a node, for splitting")(1),
    float("emptybonus", "for a side that is empty, 0 to 1")(0.5f),
    integer("maxprims", "most primitives in a leaf")(1),
    integer("maxdepth", "deepest leaf", shown = "by the count")(-1)
  )
  protected def make()(using site: Site): Primitives => Accelerator =
    BvhRecipe.accelerator(site.resources)
