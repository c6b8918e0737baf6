package candela.build.textures

import candela.build.recipe.*
import candela.textures.{FloatTexture, RgbTexture}

/** Textures by face, without texture coordinates. */
abstract class PtexRecipe[A] extends Recipe[A]("ptex", "a picture for each face", sinceV3):
  declare(
    string("filename", "a .ptx file", shown = "none")(""),
    float("gamma", "exponent that makes values linear", onlyV3)(2.2f),
    string("encoding", "sRGB, linear, or `gamma` and an exponent", onlyV4)("gamma 2.2"),
    float("scale", "factor of the values", onlyV4)(1f)
  )

object FloatPtexRecipe extends PtexRecipe[FloatTexture] with HalfFloat
object RgbPtexRecipe extends PtexRecipe[RgbTexture] with HalfRgb
