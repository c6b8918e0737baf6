package candela.bsdf

import candela.color.Rgb
import candela.math.*

/** The rough interface of two transparent media: every facet reflects and refracts.
  *
  * What is scattered twice within the roughness is lost. Refraction scales radiance by the square
  * of the relative index, so that `f(wo, wi) · eta² = f(wi, wo)` for `wo` above and `wi` below.
  *
  * @param eta           index of refraction inside (below the surface) over that outside; not 1
  * @param reflectance   multiplies the reflected light
  * @param transmittance multiplies the refracted light
  *
  * Source: Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007.
  */
final class RoughDielectric(
    distribution: MicrofacetDistribution,
    eta: Float,
    reflectance: Rgb = Rgb.White,
    transmittance: Rgb = Rgb.White
) extends LeanBsdf:
  import RoughDielectric.{facet, jacobian}

  private val maxReflectance = reflectance.max
  private val maxTransmittance = transmittance.max

  /** The index on the other side over that on the side of `wo`. */
  private def relativeEta(wo: Vec3): Float = if wo.z < 0f then 1f / eta else eta

  /** The probability that a facet of this Fresnel term is chosen to reflect; NaN: it is black. */
  private def reflects(fresnel: Float): Float =
    val r = fresnel * maxReflectance
    r / (r + (1f - fresnel) * maxTransmittance)

  def f(wo: Vec3, wi: Vec3): Rgb =
    if Hemisphere.isLevel(wo, wi) then Rgb.Black
    else
      val relative = relativeEta(wo)
      val o = Hemisphere.above(wo)
      val i = if wo.z < 0f then Hemisphere.flipped(wi) else wi
      val m = facet(o, i, relative)
      if m.isZero then Rgb.Black
      else
        val fresnel = Fresnel.dielectric(o dot m, relative)
        val density = distribution.d(m) * distribution.visibility(o, i, m)
        if i.z > 0f then reflectance * (fresnel * density)
        else
          val spread = 4f * (o dot m) * jacobian(o, i, m, relative) / (relative * relative)
          transmittance * ((1f - fresnel) * density * spread)

  def pdf(wo: Vec3, wi: Vec3): Float =
    if Hemisphere.isLevel(wo, wi) then 0f
    else
      val relative = relativeEta(wo)
      val o = Hemisphere.above(wo)
      val i = if wo.z < 0f then Hemisphere.flipped(wi) else wi
      val m = facet(o, i, relative)
      if m.isZero then 0f else density(o, i, m, relative)

  private def density(o: Vec3, i: Vec3, m: Vec3, relative: Float): Float =
    val p = reflects(Fresnel.dielectric(o dot m, relative))
    if p.isNaN then 0f
    else if i.z > 0f then p * MicrofacetReflection.pdf(distribution, o, m)
    else (1f - p) * distribution.pdf(o, m) * jacobian(o, i, m, relative)

  override def draw(wo: Vec3, choice: Float, u1: Float, u2: Float, out: Bounce): Unit =
    val relative = relativeEta(wo)
    val o = Hemisphere.above(wo)
    val m = distribution.sample(o, u1, u2)
    val cosM = o dot m
    if o.z < Hemisphere.Horizon || cosM <= 0f then out.absorb()
    else
      val fresnel = Fresnel.dielectric(cosM, relative)
      val p = reflects(fresnel)
      if p.isNaN then out.absorb()
      else if choice < p then
        val i = Hemisphere.reflected(o, m, cosM)
        if i.z < Hemisphere.Horizon then out.absorb()
        else leave(wo, o, i, m, reflectance * (fresnel / p), relative, 1f, out)
      else
        val cosT = Fresnel.cosRefracted(cosM, relative)
        if cosT <= 0f then out.absorb()
        else
          val i = Fresnel.refracted(o, m, cosM, cosT, relative)
          val passed = transmittance * ((1f - fresnel) / ((1f - p) * relative * relative))
          if i.z > -Hemisphere.Horizon then out.absorb()
          else leave(wo, o, i, m, passed, relative, relative, out)

  private def leave(
      wo: Vec3,
      o: Vec3,
      i: Vec3,
      m: Vec3,
      weight: Rgb,
      relative: Float,
      sampleEta: Float,
      out: Bounce
  ): Unit =
    val pdf = density(o, i, m, relative)
    if pdf > 0f && java.lang.Float.isFinite(pdf) then
      val wi = if wo.z < 0f then Hemisphere.flipped(i) else i
      out.set(wi, weight * distribution.sampleWeight(o, i, m), pdf, false, sampleEta)
    else out.absorb()

  def isSpecular: Boolean = false
  def isTransmissive: Boolean = !transmittance.isBlack
  override def regularized: Bsdf =
    RoughDielectric(distribution.regularized, eta, reflectance, transmittance)

object RoughDielectric:

  /** The facet that scatters `o` (above) to `i`; zero if none faces both.
    *
    * @param relative index beyond the interface over that above it
    */
  private[bsdf] def facet(o: Vec3, i: Vec3, relative: Float): Vec3 =
    val across = if i.z > 0f then o + i else o + i * relative
    if across.isZero then Vec3.Zero
    else
      val unit = across.normalized
      val m = if unit.z < 0f then -unit else unit
      if (o dot m) > 0f && (i dot m) * i.z > 0f then m else Vec3.Zero

  /** Solid angle of facet normals for that of refracted directions. */
  private[bsdf] def jacobian(o: Vec3, i: Vec3, m: Vec3, relative: Float): Float =
    val cosI = i dot m
    Math.abs(cosI) / square(cosI + (o dot m) / relative)
