package candela.build.textures

import candela.build.recipe.*
import candela.scenefile.Dialect
import candela.textures.*

abstract class NoiseRecipe[A](name: String, meaning: String, dialects: Set[Dialect])
    extends Recipe[A](name, meaning, dialects):
  private val octaves = integer(
    "octaves",
    "maximum number of octaves",
    range = Range(0f, 100f).limited
  )(8)
  private val roughness =
    float("roughness", "amplitude of an octave relative to the previous")(0.5f)

  protected def fbm()(using Site): FloatTexture = FbmTexture(Solid.filtered, octaves(), roughness())

  protected def wrinkled()(using site: Site): FloatTexture =
    WrinkledTexture(Solid.filtered, octaves(), roughness(), evenMean = site.dialect == Dialect.V2)

  protected def marble(scale: Float, variation: Float)(using site: Site): RgbTexture =
    val lastSegment = if site.dialect == Dialect.V3 then 1 else 5
    MarbleTexture(Solid.filtered, octaves(), roughness(), scale, variation, lastSegment)

object FloatFbmRecipe
    extends NoiseRecipe[FloatTexture]("fbm", "fractional Brownian motion", every):
  protected def create()(using Site): FloatTexture = fbm()

object RgbFbmRecipe
    extends NoiseRecipe[RgbTexture]("fbm", "fractional Brownian motion, as grey", untilV3):
  protected def create()(using Site): RgbTexture = GrayTexture(fbm())

object FloatWrinkledRecipe
    extends NoiseRecipe[FloatTexture]("wrinkled", "turbulence: sum of absolute noise", every):
  protected def create()(using Site): FloatTexture = wrinkled()

object RgbWrinkledRecipe
    extends NoiseRecipe[RgbTexture]("wrinkled", "turbulence, as grey", untilV3):
  protected def create()(using Site): RgbTexture = GrayTexture(wrinkled())

object FloatWindyRecipe extends Recipe[FloatTexture]("windy", "noise resembling wind-blown waves"):
  protected def create()(using Site): FloatTexture = WindyTexture(Solid.filtered)

object RgbWindyRecipe
    extends Recipe[RgbTexture]("windy", "noise resembling wind-blown waves, as grey", untilV3):
  protected def create()(using Site): RgbTexture = GrayTexture(WindyTexture(Solid.filtered))

object RgbMarbleRecipe
    extends NoiseRecipe[RgbTexture]("marble", "marble: layers of grey displaced by noise", every):
  private val scale = float("scale", "approximate number of layers per unit of length")(1f)
  private val variation = float("variation", "amplitude of the noise displacement")(0.2f)
  protected def create()(using site: Site): RgbTexture =
    val texture = marble(scale(), variation())
    if site.resources.basis.isSrgb then texture
    else RebasedTexture(texture, site.resources.basis.lookUp)
