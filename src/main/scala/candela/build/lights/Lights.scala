package candela.build.lights

import candela.build.recipe.*
import candela.color.Rgb
import candela.lights.Light
import candela.math.Transform
import candela.scenefile.Dialect

/** Recipes of lights that are no surfaces. */
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
      InfiniteLightRecipe("exinfinite", untilV3)
    )
  )

/** A light to be placed: `make` takes its transform and whether every direction must be sampled
  * (only integrators without BSDF sampling need that).
  *
  * @param samples how often v2's and v3's direct lighting samples it
  */
final case class LightPlan(make: (Transform, Boolean) => Option[Light], samples: Int)

object LightPlan:
  /** Of a light that can't shine: says so. */
  def leftOut(why: String)(using site: Site): LightPlan =
    site.warn(s"$why: the light is left out")
    nothing

  /** Of a light that an error was reported for. */
  val nothing: LightPlan = LightPlan((_, _) => None, samples = 1)

  val Black = "it emits nothing"

/** What all lights have that are no surfaces. */
abstract class LightRecipe(name: String, meaning: String, dialects: Set[Dialect] = every)
    extends Recipe[LightPlan](name, meaning, dialects):
  private val colored =
    color("scale", "factor of the light", SpectrumRole.Reflectance, untilV3)(Rgb.White)
  private val scale = float("scale", "factor of the light", onlyV4)(1f)

  protected def scaled(c: Rgb)(using Site): Rgb = c * colored() * scale()

  /** `scaled`, with v4's total given instead: `perUnit` is what the light sends out at 1. */
  protected def scaled(c: Rgb, total: Float, perUnit: Float)(using Site): Rgb =
    scaled(c) * (if total > 0f then total / perUnit else 1f)

  protected def shines(c: Rgb): Boolean = c.isFinite && c.max > 0f

/** The parameters that say how often v2's and v3's direct lighting samples a light. */
trait SampleCounts extends Fields:
  private val nsamples = integer("nsamples", "light samples of directlighting", untilV3)(1)
  private val samples =
    integer("samples", "another name of `nsamples`", onlyV3, shown = "nsamples")(1)

  protected def sampleCount()(using Site): Int =
    Math.max(1, samples.given_().getOrElse(nsamples()))
