package candela.build

import candela.color.Rgb

object Disney
    extends MaterialRecipe("disney", "the material of Burley 2012 and 2015", onlyV3)
    with GreyInstead:
  declare(
    rgbTexture("color", "of the surface")(Rgb.gray(0.5f)),
    floatTexture("metallic", "0: dielectric, 1: metal")(0f),
    floatTexture("eta", "index of refraction")(1.5f),
    floatTexture("roughness", "of the surface")(0.5f),
    floatTexture("speculartint", "highlights white, or of the surface's hue")(0f),
    floatTexture("anisotropic", "how much highlights are stretched")(0f),
    floatTexture("sheen", "of cloth, at grazing angles")(0f),
    floatTexture("sheentint", "sheen white, or of the surface's hue")(0.5f),
    floatTexture("clearcoat", "a second, thin gloss")(0f),
    floatTexture("clearcoatgloss", "how sharp that is")(1f),
    floatTexture("spectrans", "how much is refracted")(0f),
    rgbTexture("scatterdistance", "mean free path below the surface", unit = "scene units")(
      Rgb.Black
    ),
    bool("thin", "is it a thin sheet?")(false),
    floatTexture("flatness", "of a thin sheet: how flat it looks")(0f),
    floatTexture("difftrans", "of a thin sheet: transmitted diffuse light, 0 to 2")(1f)
  )
