package candela.build

import candela.color.Rgb

object Translucent
    extends RoughRecipe(
      "translucent",
      "reflects and transmits, diffuse and glossy",
      untilV3,
      0.1f,
      across = Set.empty
    )
    with GreyInstead:
  declare(
    rgbTexture("Kd", "diffuse part")(Rgb.gray(0.25f)),
    rgbTexture("Ks", "glossy part")(Rgb.gray(0.25f)),
    rgbTexture("reflect", "factor of what is reflected")(Rgb.gray(0.5f)),
    rgbTexture("transmit", "factor of what is transmitted")(Rgb.gray(0.5f))
  )
