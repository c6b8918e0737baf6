package candela.bsdf.composite

import candela.bsdf.{CosineSampled, Fresnel, Hemisphere, ReflectanceCurve}
import candela.bsdf.microfacet.MicrofacetDistribution
import candela.color.Rgb
import candela.math.*
import candela.sampling.Warp

/** The diffuse lobes of Disney's material: all terms that depend on the cosines alone.
  *
  * @param diffuse   colour and weight of the diffuse lobe, attenuated by Fresnel terms at grazing
  *                  angles
  * @param flat      colour and weight of the lobe that approximates subsurface scattering
  * @param retro     colour and weight of retro-reflection by rough surfaces
  * @param sheen     colour and weight of the sheen of cloth
  * @param roughness in [0, 1]
  *
  * Sources: Burley, "Physically Based Shading at Disney", SIGGRAPH 2012 course; Burley, "Extending
  * the Disney BRDF to a BSDF with Integrated Subsurface Scattering", SIGGRAPH 2015 course, eq. 4.
  */
final class DisneyDiffuse(diffuse: Rgb, flat: Rgb, retro: Rgb, sheen: Rgb, roughness: Float)
    extends CosineSampled:
  private val isFlat = !flat.isBlack

  protected def value(wo: Vec3, wi: Vec3): Rgb =
    val across = wo + wi
    if across.isZero then Rgb.Black
    else
      val cosO = Hemisphere.absCos(wo)
      val cosI = Hemisphere.absCos(wi)
      val cosD = wi dot across.normalized
      val o = Schlick.weight(cosO)
      val i = Schlick.weight(cosI)
      val rr = 2f * roughness * cosD * cosD
      val base = diffuse * (InvPi * (1f - 0.5f * o) * (1f - 0.5f * i)) +
        retro * (InvPi * rr * (o + i + o * i * (rr - 1f))) +
        sheen * Schlick.weight(cosD)
      if isFlat then base + flat * (InvPi * flattened(cosO, cosI, o, i, 0.5f * rr)) else base

  /** After Hanrahan and Krueger. The factor 1.25 roughly preserves the albedo. */
  private def flattened(cosO: Float, cosI: Float, o: Float, i: Float, grazing: Float): Float =
    val fss = lerp(o, 1f, grazing) * lerp(i, 1f, grazing)
    1.25f * (fss * (1f / (cosO + cosI) - 0.5f) + 0.5f)

/** Schlick's approximation of the Fresnel equations.
  *
  * Source: Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", Eurographics 1994.
  */
private[bsdf] object Schlick:

  /** (1 − cos θ)⁵: interpolates from the reflectance at normal incidence to 1. */
  def weight(cosine: Float): Float =
    val m = clamp(1f - cosine, 0f, 1f)
    square(m * m) * m

  /** Reflectance of a dielectric at normal incidence. */
  def normal(eta: Float): Float = square((eta - 1f) / (eta + 1f))

/** Fresnel reflectance of Disney's material: a blend of a dielectric and Schlick's metal.
  *
  * @param normal   reflectance of the metal at normal incidence
  * @param metallic blend factor, 0: dielectric, 1: metal
  * @param eta      index of refraction of the dielectric
  */
final class DisneyReflectance(normal: Rgb, metallic: Float, eta: Float) extends ReflectanceCurve:
  def apply(cosTheta: Float): Rgb =
    val weight = Schlick.weight(cosTheta)
    val metal = normal.map(n => lerp(weight, n, 1f)) * metallic
    metal + Rgb.gray((1f - metallic) * Fresnel.dielectric(cosTheta, eta))

/** Reflectance of a clear coat of index 1.5, by Schlick's approximation. */
private[bsdf] object ClearcoatReflectance extends ReflectanceCurve:
  def apply(cosTheta: Float): Rgb = Rgb.gray(lerp(Schlick.weight(Math.abs(cosTheta)), 0.04f, 1f))

/** Microfacet distribution of Disney's clear coat. Its tails are longer than those of
  * [[TrowbridgeReitz]]; the masking uses a fixed roughness.
  *
  * @param alpha  roughness, in (0, 1)
  * @param isBare leaves out 1 / (4 cos θo cos θi), as Mitsuba does
  *
  * Source: Burley 2012, appendix B (GTR with γ = 1).
  */
final class ClearcoatDistribution(alpha: Float, isBare: Boolean = false)
    extends MicrofacetDistribution:
  import ClearcoatDistribution.MaskingAlpha2
  private val alpha2 = alpha.toDouble * alpha
  private val area = (alpha2 - 1.0) / (Math.PI * Math.log(alpha2))

  def isSmooth: Boolean = false
  def isIsotropic: Boolean = true
  def isNarrow: Boolean = false // Most of its light is in the tails

  def d(m: Vec3): Float =
    // 1 − (1 − α²) cos²θ, without cancellation near the normal
    val sine2 = m.x.toDouble * m.x + m.y.toDouble * m.y
    (area / (sine2 + alpha2 * m.z * m.z)).toFloat

  private def masked(w: Vec3): Float =
    val cosine = Math.abs(w.z)
    1f / (cosine + sqrt(MaskingAlpha2 + cosine * cosine * (1f - MaskingAlpha2)))

  def visibility(wo: Vec3, wi: Vec3, m: Vec3): Float =
    val smith = 0.25f * masked(wo) * masked(wi)
    if isBare then smith * (4f * Math.abs(wo.z * wi.z)) else smith

  def pdf(wo: Vec3, m: Vec3): Float = d(m) * m.z

  def sample(wo: Vec3, u1: Float, u2: Float): Vec3 =
    // Samples sin²θ rather than cos²θ: most are tiny
    val sine2 = (Math.pow(alpha2, 1.0 - u2) - alpha2) / (1.0 - alpha2)
    val sine = Math.sqrt(Math.max(0.0, sine2))
    Warp.spherical(Math.sqrt(Math.max(0.0, 1.0 - sine2)).toFloat, sine.toFloat, u1)

  def sampleWeight(wo: Vec3, wi: Vec3, m: Vec3): Float =
    if m.z > 0f then 4f * Math.abs(wi.z) * visibility(wo, wi, m) * Math.abs(wo dot m) / m.z else 0f

object ClearcoatDistribution:
  private inline val MaskingAlpha2 = 0.0625f
