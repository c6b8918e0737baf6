package candela.build.textures

import candela.build.recipe.*
import candela.math.*
import candela.textures.*

/** Base of Mitsuba's grids on surfaces. */
abstract class GridRecipe[A](meaning: String, channels: Int)
    extends Recipe[A]("grid", meaning, onlyV4)
    with HasCells
    with HasBox:
  private val values = numbers("values", "float[]", s"$channels for each cell, x fastest")

  /** The mapping to the unit cube, and the channels; None if the parameters are wrong. */
  protected def grids()(using Site): Option[(Mapping3D, Vector[TrilinearGrid])] =
    for
      (nx, ny, nz) <- cells("values", values(), channels)
      toGrid <- toUnit()
    yield
      def grid(c: Int) =
        TrilinearGrid(nx, ny, nz, channel(values(), c, channels), GridEdge.Clamped)
      (Mapping3D(toGrid), Vector.tabulate(channels)(grid))

object FloatGridRecipe extends GridRecipe[FloatTexture]("numbers in a box; Mitsuba's", 1):
  protected def make()(using Site): FloatTexture =
    grids().fold(StandIns.number)((mapping, grids) => FloatGridTexture(mapping, grids.head))

object RgbGridRecipe extends GridRecipe[RgbTexture]("colours in a box; Mitsuba's", 3):
  protected def make()(using site: Site): RgbTexture =
    val basis = site.resources.basis
    grids().fold(StandIns.color(basis)): (mapping, grids) =>
      val made = RgbGridTexture(mapping, grids(0), grids(1), grids(2))
      if basis.isSrgb then made else RebasedTexture(made, basis.lookUp)
