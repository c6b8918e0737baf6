package candela.build

object CurveRecipe
    extends ShapeRecipe("curve", "strands of hair, grass and the like", sinceV3)
    with LeftOut:
  declare(
    numbers("P", "point3[]", "control points"),
    oneOf("basis", "what the control points mean", Vector("bezier", "bspline"))("bezier"),
    integer("degree", "of the polynomials, 2 or 3")(3),
    oneOf("type", "what it looks like", Vector("flat", "ribbon", "cylinder"))("flat"),
    numbers("N", "normal[]", "of a ribbon: normals, one more than there are segments"),
    float("width", "all along", unit = "scene units")(1f),
    float("width0", "at the start", unit = "scene units", shown = "width")(1f),
    float("width1", "at the end", unit = "scene units", shown = "width")(1f)
  )
  noMeaning("curves are split as needed")(
    integer("splitdepth", "times that each segment is halved beforehand")(3)
  )
