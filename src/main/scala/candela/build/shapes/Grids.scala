package candela.build

object HeightFieldRecipe
    extends ShapeRecipe("heightfield", "heights over the unit square", untilV3)
    with LeftOut:
  declare(
    integer("nu", "heights along x", shown = "none")(-1),
    integer("nv", "heights along y", shown = "none")(-1),
    numbers("Pz", "float[]", "nu by nv heights, x first", unit = "scene units")
  )

object NurbsRecipe
    extends ShapeRecipe("nurbs", "non-uniform rational B-splines", untilV3)
    with LeftOut:
  for d <- Seq("u", "v") do
    declare(
      integer(s"n$d", s"control points along $d", shown = "none")(-1),
      integer(s"${d}order", s"order along $d: the degree plus one", shown = "none")(-1),
      numbers(s"${d}knots", "float[]", s"knots along $d: points and order together"),
      float(s"${d}0", s"where $d starts", shown = s"${d}knots[${d}order - 1]")(0f),
      float(s"${d}1", s"where $d ends", shown = s"${d}knots[n$d]")(1f)
    )
  declare(
    numbers("P", "point3[]", "control points"),
    numbers("Pw", "float[]", "control points with weights, four numbers each, instead of `P`")
  )
