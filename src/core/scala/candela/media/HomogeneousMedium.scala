package candela.media

import candela.color.Rgb
import candela.geometry.Ray
import candela.math.*
import candela.sampling.PhaseFunction

/** Homogeneous, unbounded medium. Distances and transmittances are exact.
  *
  * @param absorption, scattering coefficients, per scene unit
  * @param emitted    radiance where the medium is opaque and purely absorbing
  */
final class HomogeneousMedium(
    absorption: Rgb,
    scattering: Rgb,
    emitted: Rgb,
    val phase: PhaseFunction
) extends Medium:
  private val extinction = absorption + scattering
  private val glow = absorption * emitted
  val isEmissive: Boolean = !glow.isBlack
  val isChromatic: Boolean = Medium.isChromatic(absorption, scattering)
  def describe: String = "homogeneous"

  def follow(ray: Ray, first: Float, emits: Boolean, work: MediumWork): Float =
    val w = work.weights
    val unit = ray.direction.length
    val end = Math.min(ray.tMax * unit, Float.MaxValue)
    if emits && isEmissive then
      work.glowR += w.r * emittedWithin(end, glow.r, extinction.r)
      work.glowG += w.g * emittedWithin(end, glow.g, extinction.g)
      work.glowB += w.b * emittedWithin(end, glow.b, extinction.b)
    val ofHero = w.ofHero(scattering.r, scattering.g, scattering.b)
    val distance = if ofHero > 0f then -log(1f - first) / ofHero else Float.PositiveInfinity
    val scatters = distance < end
    val length = if scatters then distance else end
    // The hero's pdf of this event is ofHero·exp(−ofHero·length), or without the factor
    val s = scattering
    val t = extinction
    w.scale(weight(t.r, ofHero, length), weight(t.g, ofHero, length), weight(t.b, ofHero, length))
    w.scaleDensity(
      weight(s.r, ofHero, length),
      weight(s.g, ofHero, length),
      weight(s.b, ofHero, length)
    )
    if scatters then
      val inverse = 1f / ofHero
      w.scale(s * inverse)
      w.scaleDensity(s.r * inverse, s.g * inverse, s.b * inverse)
    else
      // Light sampling uses the exact transmittance: its probability of passing is 1
      val passing = weight(0f, ofHero, length)
      w.scaleLight(passing, passing, passing)
    w.balance()
    if scatters then distance / unit else -1f

  def attenuate(ray: Ray, work: MediumWork): Unit =
    val w = work.shadow
    val length = Math.min(ray.tMax * ray.direction.length, Float.MaxValue)
    w.scale(
      weight(extinction.r, 0f, length),
      weight(extinction.g, 0f, length),
      weight(extinction.b, 0f, length)
    )
    w.scaleDensity(
      weight(scattering.r, 0f, length),
      weight(scattering.g, 0f, length),
      weight(scattering.b, 0f, length)
    )

  /** exp(−(sigma − ofHero)·length), with 0 times infinity as 0. */
  private def weight(sigma: Float, ofHero: Float, length: Float): Float =
    if sigma == ofHero then 1f else exp((ofHero - sigma) * length)

  /** ∫ of glow·exp(−sigma·t) dt from 0 to `length`. */
  private def emittedWithin(length: Float, glow: Float, sigma: Float): Float =
    if glow == 0f then 0f else -Math.expm1((-sigma * length).toDouble).toFloat * glow / sigma
