package candela.build.lights

import candela.diagnostics.Code
import candela.build.recipe.*
import candela.color.Rgb
import candela.lights.Light
import candela.math.Transform
import candela.scenefile.Dialect

/** Recipes of lights other than area lights. */
object Lights:
  val all: Recipes[LightPlan] = Recipes(
    "light",
    Vector(
      PointLightRecipe,
      SpotLightRecipe,
      GoniometricLightRecipe,
      ProjectionLightRecipe,
      DistantLightRecipe,
      InfiniteLightRecipe("infinite", every),
      InfiniteLightRecipe("exinfinite", untilV3),
      SunskyLightRecipe
    )
  )

/** Plan of a light: `create` takes its transform, and what must be sampled of it if it is a sky.
  *
  * @param samples light samples per point in v2's and v3's direct lighting
  */
final case class LightPlan(create: (Transform, SkySampling) => Option[Light], samples: Int)

/** What light samples must find of a sky; what they leave out, paths find as well by themselves. */
enum SkySampling:
  /** What is brighter than the mean. */
  case Bright

  /** All, but for uniform skies. */
  case Uneven
  case All

object UniformScale:
  /** Whether the transform keeps lengths. */
  def isOne(scale: Option[Double]): Boolean = scale.exists(s => Math.abs(s - 1) <= 1e-5)

object LightPlan:
  /** Plan of a light without effect, with a warning. */
  def leftOut(why: String)(using site: Site): LightPlan =
    site.warn(Code.DarkLight, s"$why; the light is ignored")
    nothing

  /** Plan of a light with a reported error. */
  val nothing: LightPlan = LightPlan((_, _) => None, samples = 1)

  val Black = "this light emits nothing"

/** Base of light recipes, except area lights. */
abstract class LightRecipe(name: String, meaning: String, dialects: Set[Dialect] = every)
    extends Recipe[LightPlan](name, meaning, dialects):
  private val colored =
    color("scale", "scale of the light", SpectrumRole.Reflectance, untilV3)(Rgb.White)
  private val scale = float("scale", "scale of the light", onlyV4)(1f)

  protected def scaled(c: Rgb)(using Site): Rgb = c * colored() * scale()

  /** As `scaled`, with v4's total power: `perUnit` is the power at an emission of 1. */
  protected def scaled(c: Rgb, total: Float, perUnit: => Float)(using Site): Rgb =
    scaled(c) * (if total > 0f then total / perUnit else 1f)

  /** At three wavelengths, a light may be black. */
  protected def shines(c: Rgb)(using site: Site): Boolean =
    site.resources.basis.isSpectral || (c.isFinite && c.max > 0f)

private[build] object ScaledLight:

  /** Warns that pbrt renders a light under this transform otherwise.
    *
    * @param dialects whose programs do
    * @param isExact  whether they render it as it is, given its uniform scale, if it has one
    * @param effect   what they do
    */
  def warn(dialects: Set[Dialect], isExact: Option[Double] => Boolean, effect: String)(using
      site: Site
  ): Unit =
    if dialects(site.rules.dialect) && !site.toWorld.isFlat &&
      !isExact(site.toWorld.uniformScale)
    then
      site.warn(
        Code.UnlikePbrt,
        s"the transform of this light scales it; ${site.rules.program} $effect, so its image " +
          "differs"
      )

/** Number of samples of a light in v2's and v3's direct lighting. */
trait SampleCounts extends Fields:
  private val nsamples =
    integer(
      "nsamples",
      "light samples per point in \"directlighting\"",
      untilV3,
      range = Range.atLeast(1f).limited
    )(1)
  private val samples =
    integer(
      "samples",
      "alias of `nsamples`",
      onlyV3,
      shown = "nsamples",
      range = Range.atLeast(1f).limited
    )(1)

  protected def sampleCount()(using Site): Int = samples.given_().getOrElse(nsamples())
