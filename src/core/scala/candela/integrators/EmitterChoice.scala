package candela.integrators

import candela.lights.Light
import candela.sampling.{Discrete, Sampler}
import candela.scene.Scene

/** Chooses the light at which a light path begins, by power. Immutable.
  *
  * @param begins may paths begin at a light?
  */
final class EmitterChoice(scene: Scene, begins: Light => Boolean):
  private val powers = scene.lights.map: light =>
    if begins(light) then Discrete.weight(light.power(scene.ball)) else 0f
  private val choice: Discrete | Null = if powers.exists(_ > 0f) then Discrete(powers) else null

  /** May no path begin? */
  def isEmpty: Boolean = choice == null

  /** Probability of the light. */
  def chance(light: Int): Float =
    val picks = choice
    if picks == null then 0f else picks.probability(light)

  /** Index of the chosen light; −1: there is none. */
  def sample(sampler: Sampler): Int =
    val picks = choice
    if picks == null then -1 else picks.sample(sampler.next1D())
