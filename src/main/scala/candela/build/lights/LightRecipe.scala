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
  private val colored =
    color("scale", "factor of the light", SpectrumRole.Reflectance, untilV3)(Rgb.White)
  private val scale = float("scale", "factor of the light", onlyV4)(1f)

  protected def scaled(c: Rgb)(using Site): Rgb = c * colored() * scale()

/** Of lights that are not rendered yet. */
trait Dark extends Recipe[LightPlan]:
  override def pending: Option[String] = Some("it is left out")
  protected def make()(using Site): LightPlan = LightPlan((_, _) => None, samples = 1)
