package candela.build.options

import candela.accel.{Accelerator, Primitives}
import candela.accel.tracing.{Grid, Hierarchies}
import candela.build.recipe.*

/** Makes an accelerator for primitives and a number of camera samples. */
type AcceleratorPlan = (Primitives, Long) => Accelerator

/** Recipes of accelerators, none of which changes the image. */
object Accelerators:
  val all: Recipes[AcceleratorPlan] =
    Recipes("accelerator", Vector(BvhRecipe, GridRecipe, KdTreeRecipe))

object BvhRecipe
    extends Recipe[AcceleratorPlan]("bvh", "bounding volume hierarchy"):
  noMeaning("Candela builds its own BVH")(
    string("splitmethod", "split method: sah, hlbvh, middle, equal")("sah"),
    integer("maxnodeprims", "maximum primitives per leaf")(4)
  )
  protected def create()(using site: Site): AcceleratorPlan = accelerator(site.resources)

  /** The default accelerator. */
  def accelerator(resources: Resources): AcceleratorPlan =
    (primitives, samples) =>
      Hierarchies.of(primitives, resources.pool, samples, resources.warmUps, resources.cache)

object GridRecipe
    extends Recipe[AcceleratorPlan]("grid", "uniform grid", onlyV2):
  noMeaning("all shapes are refined in advance")(
    bool("refineimmediately", "refine all shapes when the grid is built")(false)
  )
  protected def create()(using Site): AcceleratorPlan = (primitives, _) => Grid(primitives)

object KdTreeRecipe
    extends Recipe[AcceleratorPlan]("kdtree", "k-d tree"):
  override def substitute: Option[String] = Some("using \"bvh\", with the same image")
  declare(
    integer("intersectcost", "SAH cost of intersecting a primitive")(if v4 then 5 else 80),
    integer("traversalcost", "SAH cost of traversing a node")(1),
    float("emptybonus", "SAH bonus for an empty child, 0 to 1")(0.5f),
    integer("maxprims", "maximum primitives per leaf")(1),
    integer("maxdepth", "maximum depth", shown = "by the count")(-1)
  )
  protected def create()(using site: Site): AcceleratorPlan =
    BvhRecipe.accelerator(site.resources)
