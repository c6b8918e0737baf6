package candela.build

object Environment
    extends ProjectiveRecipe(
      "environment",
      "looks to all sides, as an equirectangular map",
      untilV3
    )
    with PerspectiveInstead

object Spherical
    extends ProjectiveRecipe("spherical", "looks to all sides", onlyV4)
    with PerspectiveInstead:
  declare(
    oneOf("mapping", "layout of the image", Vector("equalarea", "equirectangular"))("equalarea")
  )

object Realistic
    extends CameraRecipe("realistic", "lenses of glass, from a table", sinceV3)
    with PerspectiveInstead:
  declare(
    string("lensfile", "radius, thickness, index and diameter of each surface", shown = "none")(""),
    float("aperturediameter", "of the stop", unit = "mm")(1f),
    float("focusdistance", "to the plane in focus", unit = "m")(10f),
    bool("simpleweighting", "are all rays weighted alike?", onlyV3)(true),
    string(
      "aperture",
      "shape of the stop: gaussian, square, pentagon, star, or an image",
      onlyV4,
      "round"
    )("")
  )
