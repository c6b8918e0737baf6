package candela.build

import candela.color.Rgb

object Mix
    extends MaterialRecipe("mix", "a blend of two named materials", every, bumps = false)
    with GreyInstead:
  declare(
    string("namedmaterial1", "where `amount` is 1", untilV3, "none")(""),
    string("namedmaterial2", "where `amount` is 0", untilV3, "none")(""),
    rgbTexture("amount", "of the first", untilV3)(Rgb.gray(0.5f)),
    strings("materials", "string[2]", "where `amount` is 0, and where it is 1", onlyV4),
    floatTexture("amount", "of the second", onlyV4)(0.5f)
  )
