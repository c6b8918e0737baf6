package candela.build

import candela.color.Rgb
import candela.lights.Light
import candela.math.Transform
import candela.scenefile.Dialect

/** A light to be placed: `make` takes its transform and whether every direction must be sampled
  * (only integrators without BSDF sampling need that).
  *
  * @param samples how often v2's and v3's direct lighting samples it
  */
final case class LightPlan(make: (Transform, Boolean) => Option[Light], samples: Int)

/** What all lights have that are no surfaces. */
abstract class LightRecipe(name: String, meaning: String, dialects: Set[Dialect] = every)
    extends Recipe[LightPlan](name, meaning, dialects):
  private val scale = color("scale", "factor of the light", SpectrumRole.Reflectance)(Rgb.White)
  private val nsamples = integer("nsamples", "light samples of directlighting", untilV3)(1)
  private val samples = integer("samples", "another name of `nsamples`", untilV3)(1)

  protected def scaled(c: Rgb)(using Site): Rgb = c * scale()
  protected def sampleCount()(using Site): Int =
    Math.max(1, samples.given_().getOrElse(nsamples()))
