package candela.build.shapes

import candela.build.recipe.*
import candela.shapes.{LoopSubdivision, MeshError}

object LoopSubdivRecipe extends ShapeRecipe("loopsubdiv", "Loop's subdivision surface"):
  private val levels = integer("levels", "times that each triangle is split into four", sinceV3)(3)
  private val nlevels =
    integer("nlevels", "times that each triangle is split into four", untilV3)(3)
  private val indices = integers("indices", "three vertices a triangle of the control mesh")
  private val points = numbers("P", "point3[]", "vertices of the control mesh")
  noMeaning("there is but one")(string("scheme", "kind of subdivision")("loop"))

  protected def geometry()(using site: Site): Option[ShapeGeometry] =
    val depth = levels.given_().orElse(nlevels.given_()).getOrElse(3)
    if points().isEmpty || indices().isEmpty then
      site.error("a loopsubdiv needs `P` and `indices`")
      None
    else if depth < 0 || depth > 10 then
      site.error(s"`levels` of loopsubdiv lies in 0 to 10; found $depth")
      None
    else
      MeshArrays.checked(points(), Array.empty, Array.empty, indices()).flatMap: _ =>
        try
          val fine = LoopSubdivision.subdivide(depth, indices(), points())
          Some(ShapeGeometry.Triangles(fine.positions, fine.normals, Array.empty, fine.indices))
        catch
          case e: MeshError =>
            site.error(s"loopsubdiv: ${e.getMessage}")
            None
