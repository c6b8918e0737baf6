package candela.build

import candela.scenefile.Dialect
import candela.textures.{FloatTexture, RgbTexture}

/** Sums of noise. */
abstract class NoiseRecipe[A](name: String, meaning: String, dialects: Set[Dialect])
    extends Recipe[A](name, meaning, dialects):
  declare(
    integer("octaves", "noises that are added, each of twice the frequency")(8),
    float("roughness", "how much weaker each noise is than the one before")(0.5f)
  )

private val FbmMeaning = "fractal noise"
private val WrinkledMeaning = "fractal noise of absolute values"

object FloatFbm extends NoiseRecipe[FloatTexture]("fbm", FbmMeaning, every) with HalfFloat
object RgbFbm extends NoiseRecipe[RgbTexture]("fbm", FbmMeaning, untilV3) with HalfRgb

object FloatWrinkled
    extends NoiseRecipe[FloatTexture]("wrinkled", WrinkledMeaning, every)
    with HalfFloat
object RgbWrinkled
    extends NoiseRecipe[RgbTexture]("wrinkled", WrinkledMeaning, untilV3)
    with HalfRgb

object FloatWindy extends Recipe[FloatTexture]("windy", "waves on water", every) with HalfFloat
object RgbWindy extends Recipe[RgbTexture]("windy", "waves on water", untilV3) with HalfRgb

object RgbMarble extends NoiseRecipe[RgbTexture]("marble", "layers of stone", every) with HalfRgb:
  declare(
    float("scale", "frequency of the layers")(1f),
    float("variation", "how much noise moves them")(0.2f)
  )
