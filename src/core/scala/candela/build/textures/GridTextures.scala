package candela.build.textures

import candela.build.recipe.*
import candela.math.*
import candela.textures.*

/** Base of Mitsuba's grids on surfaces. */
abstract class GridRecipe[A](meaning: String, channels: Int)
    extends Recipe[A]("grid", meaning, onlyMitsuba)
    with HasCells
    with HasBox:
  private val values = numbers("values", "float[]", s"$channels for each cell, x fastest")
  private val space = oneOf("mapping", "space of the box", Seq("world", "uv"))("world")

  /** The mapping to the unit cube, and the channels; None if the parameters are wrong. */
  protected def grids()(using Site): Option[(GridPlace, Vector[TrilinearGrid])] =
    for
      (nx, ny, nz) <- cells("values", values(), channels)
      place <-
        if space() == "uv" then Some(GridPlace.OfUv)
        else toUnit().map(m => GridPlace.InSpace(Mapping3D(m)))
    yield
      // Beside the corners of triangles, values may be below 0
      val all = values() // checked, each time
      def channelValues(c: Int) = Array.tabulate(all.length / channels): i =>
        val v = all(i * channels + c)
        if java.lang.Float.isFinite(v) then v else 0f
      (
        place,
        Vector.tabulate(channels)(c =>
          TrilinearGrid(nx, ny, nz, channelValues(c), GridEdge.Clamped)
        )
      )

object FloatGridRecipe extends GridRecipe[FloatTexture]("numbers in a box", 1):
  protected def create()(using Site): FloatTexture =
    grids().fold(StandIns.number)((mapping, grids) => FloatGridTexture(mapping, grids.head))

object RgbGridRecipe extends GridRecipe[RgbTexture]("colours in a box", 3):
  protected def create()(using site: Site): RgbTexture =
    val basis = site.resources.basis
    grids().fold(StandIns.color(basis)): (mapping, grids) =>
      val texture = RgbGridTexture(mapping, grids(0), grids(1), grids(2))
      if basis.isSrgb then texture else RebasedTexture(texture, basis.lookUp)

/** The alpha of the colours that the vertices of a mesh have. */
object FloatVertexRecipe
    extends Recipe[FloatTexture]("vertexcolor", "alpha of the vertices' colours", onlyGltf):
  protected def create()(using Site): FloatTexture = VertexAlpha

/** These colours. */
object RgbVertexRecipe
    extends Recipe[RgbTexture]("vertexcolor", "colours of the vertices", onlyGltf):
  protected def create()(using site: Site): RgbTexture =
    val basis = site.resources.basis
    if basis.isSrgb then VertexRgb else RebasedTexture(VertexRgb, basis.lookUp)
