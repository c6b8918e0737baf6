package candela.bsdf.microfacet

import candela.bsdf.{Bounce, Bsdf, BsdfFlags, Hemisphere, LeanBsdf, ReflectanceCurve}
import candela.color.Rgb
import candela.math.*

/** Torrance–Sparrow microfacet reflection, the same on both sides except for `curve`.
  *
  * @param scale scale of the microfacet reflectance `curve`
  *
  * Source: Torrance and Sparrow, "Theory for Off-Specular Reflection From Roughened Surfaces", JOSA
  * 57, 1967; PBRT 4th ed., §9.6.
  */
final class MicrofacetReflection(
    distribution: MicrofacetDistribution,
    curve: ReflectanceCurve,
    scale: Rgb = Rgb.White
) extends LeanBsdf:

  def f(wo: Vec3, wi: Vec3): Rgb =
    if !Hemisphere.isSameSide(wo, wi) then Rgb.Black
    else value(Hemisphere.above(wo), Hemisphere.above(wi), isBelow = wo.z < 0f)

  override def reflectedAcross(wo: Vec3, wi: Vec3): Rgb =
    value(wo, wi, isBelow = wo.z + wi.z < 0f)

  private def value(o: Vec3, i: Vec3, isBelow: Boolean): Rgb =
    val halfVector = (o + i).normalized
    val cosM = o dot halfVector
    // Both grazing and opposite: rounding has displaced the half vector. Such directions are
    // never sampled.
    if !(cosM > 0f) then Rgb.Black
    else
      val m = halfVector.facing(Vec3.Z)
      scale * curve(if isBelow then -cosM else cosM) *
        (distribution.d(m) * distribution.visibility(o, i, m))

  def pdf(wo: Vec3, wi: Vec3): Float =
    if !Hemisphere.isSameSide(wo, wi) then 0f
    else
      val o = Hemisphere.above(wo)
      MicrofacetReflection.pdf(distribution, o, (o + Hemisphere.above(wi)).normalized)

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val o = Hemisphere.above(wo)
    val m = distribution.sample(o, u1, u2)
    val cosM = o dot m
    val i = Hemisphere.reflected(o, m, cosM)
    if o.z < Hemisphere.Horizon || cosM <= 0f || i.z < Hemisphere.Horizon then out.absorb()
    else
      val weight = scale * curve(oriented(cosM, wo)) * distribution.sampleWeight(o, i, m)
      val density = MicrofacetReflection.pdf(distribution, o, m)
      if density > 0f then
        out.set(Hemisphere.seenFrom(wo, i), weight, density, false)
      else out.absorb()

  private def oriented(cosM: Float, wo: Vec3): Float = if wo.z < 0f then -cosM else cosM

  def flags: BsdfFlags = distribution.flags
  override def regularized: Bsdf = MicrofacetReflection(distribution.regularized, curve, scale)

object MicrofacetReflection:

  /** The pdf of the direction reflected by a microfacet `m` sampled for `wo`; `wo.z` ≥ 0. */
  private[bsdf] def pdf(distribution: MicrofacetDistribution, wo: Vec3, m: Vec3): Float =
    val cosM = wo dot m
    if cosM > 0f then distribution.pdf(wo, m) / (4f * cosM) else 0f
