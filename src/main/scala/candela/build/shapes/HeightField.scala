package candela.build.shapes

import candela.base.loop
import candela.build.recipe.*

object HeightFieldRecipe
    extends ShapeRecipe("heightfield", "heights above a grid over the unit square", untilV3):
  private val nu = integer("nu", "grid points along x", shown = "none")(0)
  private val nv = integer("nv", "grid points along y", shown = "none")(0)
  private val heights = numbers("Pz", "float[]", "heights, row by row of constant y")

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val (columns, rows, z) = (nu(), nv(), heights())
    if z.isEmpty || nu.given_().isEmpty || nv.given_().isEmpty then
      site.error("a heightfield needs `nu`, `nv` and `Pz`")
      None
    else if columns < 2 || rows < 2 then
      site.warn(
        s"a heightfield needs two points or more both ways; this has $columns × $rows, and is " +
          "left out"
      )
      None
    else if z.length != columns.toLong * rows then
      site.error(s"`Pz` holds ${z.length} heights; nu × nv are ${columns.toLong * rows}")
      None
    else
      val uvs = new Array[Float](2 * z.length)
      val positions = new Array[Float](3 * z.length)
      loop(z.length): i =>
        uvs(2 * i) = (i % columns).toFloat / (columns - 1)
        uvs(2 * i + 1) = (i / columns).toFloat / (rows - 1)
        positions(3 * i) = uvs(2 * i)
        positions(3 * i + 1) = uvs(2 * i + 1)
        positions(3 * i + 2) = z(i)
      MeshArrays.checked(positions, Array.empty, uvs, MeshArrays.grid(columns, rows))
