package candela.build

import candela.color.Rgb

object Hair
    extends MaterialRecipe("hair", "curves that scatter as hair does", sinceV3, bumps = false)
    with GreyInstead:
  declare(
    rgbTexture(
      "sigma_a",
      "absorption coefficient inside",
      unit = "1/width",
      shown = "of eumelanin 1.3"
    )(Rgb.Black),
    rgbTexture("color", "instead of `sigma_a`: of the hair", shown = "none")(Rgb.Black),
    rgbTexture("reflectance", "another name of `color`", onlyV4, shown = "none")(Rgb.Black),
    floatTexture("eumelanin", "instead of `sigma_a`: black and brown pigment", shown = "none")(0f),
    floatTexture("pheomelanin", "instead of `sigma_a`: red pigment", shown = "none")(0f),
    floatTexture("eta", "index of refraction")(1.55f),
    floatTexture("beta_m", "roughness along the hair, 0 to 1")(0.3f),
    floatTexture("beta_n", "roughness around the hair, 0 to 1")(0.3f),
    floatTexture("alpha", "tilt of the scales", unit = "degrees")(2f)
  )
