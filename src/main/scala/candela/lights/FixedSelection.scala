package candela.lights

import candela.geometry.Ball
import candela.math.*
import candela.sampling.Discrete

/** By what the lights of a scene are chosen.
  *
  * All have the same mean; how noisy an image is depends on it. `Importance` goes by place and
  * normal (a tree of lights), `Power` by the light that each sends into the scene, `Uniform` takes
  * all alike.
  */
enum LightStrategy:
  case Importance, Power, Uniform

/** The same chances everywhere.
  *
  * @param weights of the lights, on any scale; 0: never chosen
  *
  * Source: PBRT 3rd ed., §14.3.1; 4th ed., §12.6.1 and §12.6.2.
  */
final class FixedSelection(weights: Array[Float], override val describe: String)
    extends LightSelection:
  private val table: Discrete | Null = if weights.exists(_ > 0f) then Discrete(weights) else null

  def choose(p: Vec3, n: Vec3, u: Float): Int =
    val picks = table
    if picks == null then -1 else picks.sample(u)

  def probability(p: Vec3, n: Vec3, light: Int): Float =
    val picks = table
    if picks == null then 0f else picks.probability(light)

  def choose(p: Vec3, n: Vec3, u: Float, out: LightChoice): Unit =
    out.light = choose(p, n, u)
    out.probability = if out.light < 0 then 0f else probability(p, n, out.light)

object FixedSelection:
  /** @param scene holds all surfaces: what the power of far lights falls on */
  def byPower(lights: Array[Light], scene: Ball): FixedSelection =
    val powers = lights.map(l => if l.isSampled then Math.max(0f, l.power(scene)) else 0f)
    val known = powers.filter(_ > 0f)
    val mean = if known.isEmpty then 1f else known.sum / known.length
    // Surroundings seen through a portal don't tell how much comes in
    val weights = lights.zip(powers).map: (light, power) =>
      if power == 0f && light.isSampled && light.bounds.isEmpty then mean else power
    FixedSelection(weights, s"${lights.length} lights, by power")

  def uniform(lights: Array[Light]): FixedSelection =
    FixedSelection(
      lights.map(l => if l.isSampled then 1f else 0f),
      s"${lights.length} lights, all alike"
    )
