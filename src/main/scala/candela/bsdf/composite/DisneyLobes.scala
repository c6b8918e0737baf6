package candela.bsdf.composite

import candela.bsdf.{CosineSampled, Fresnel, Hemisphere, ReflectanceCurve}
import candela.bsdf.microfacet.{MicrofacetDistribution, TrowbridgeReitz}
import candela.color.Rgb
import candela.math.*

/** The broad part of Disney's material: all that goes by the cosines alone.
  *
  * @param diffuse   colour and weight of reflection that a coat's Fresnel terms dim at grazing
  *                  angles
  * @param flat      of an approximation of scattering below the surface, which looks flat
  * @param retro     of light that rough surfaces send back to where it came from
  * @param sheen     of the sheen of cloth
  * @param roughness of the surface, in [0, 1]
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
      val back = 2f * roughness * cosD * cosD
      val base = diffuse * (InvPi * (1f - 0.5f * o) * (1f - 0.5f * i)) +
        retro * (InvPi * back * (o + i + o * i * (back - 1f))) +
        sheen * Schlick.weight(cosD)
      if isFlat then base + flat * (InvPi * flattened(cosO, cosI, o, i, 0.5f * back)) else base

  /** After Hanrahan and Krueger. Its factor 1.25 keeps the albedo roughly. */
  private def flattened(cosO: Float, cosI: Float, o: Float, i: Float, grazing: Float): Float =
    val both = lerp(o, 1f, grazing) * lerp(i, 1f, grazing)
    1.25f * (both * (1f / (cosO + cosI) - 0.5f) + 0.5f)

/** The approximation of Fresnel's equations of Schlick, "An Inexpensive BRDF Model for
  * Physically-based Rendering", Eurographics 1994.
  */
private[bsdf] object Schlick:

  /** (1 − cos θ)⁵: how far from the reflectance at normal incidence to 1. */
  def weight(cosine: Float): Float =
    val m = clamp(1f - cosine, 0f, 1f)
    square(m * m) * m

  /** What an interface of this index reflects at normal incidence. */
  def normal(eta: Float): Float = square((eta - 1f) / (eta + 1f))

/** How much the facets of Disney's material reflect: between a dielectric and Schlick's metal.
  *
  * @param normal   reflectance of the metal at normal incidence
  * @param metallic how much of a metal it is, in [0, 1]
  * @param eta      index of refraction of the dielectric
  */
final class DisneyReflectance(normal: Rgb, metallic: Float, eta: Float) extends ReflectanceCurve:
  def apply(cosTheta: Float): Rgb =
    val weight = Schlick.weight(cosTheta)
    val metal = normal.map(n => lerp(weight, n, 1f)) * metallic
    metal + Rgb.gray((1f - metallic) * Fresnel.dielectric(cosTheta, eta))

/** What a clear coat of index 1.5 reflects, by Schlick's approximation. */
private[bsdf] object ClearcoatReflectance extends ReflectanceCurve:
  def apply(cosTheta: Float): Rgb = Rgb.gray(lerp(Schlick.weight(Math.abs(cosTheta)), 0.04f, 1f))

/** [[TrowbridgeReitz]] with shadowing and masking that know nothing of each other, as Disney's
  * material has it.
  */
final class SeparableTrowbridgeReitz(alphaX: Float, alphaY: Float) extends MicrofacetDistribution:
  private val inner = TrowbridgeReitz(alphaX, alphaY)

  def isSmooth: Boolean = false
  def d(m: Vec3): Float = inner.d(m)
  def pdf(wo: Vec3, m: Vec3): Float = inner.pdf(wo, m)
  def sample(wo: Vec3, u1: Float, u2: Float): Vec3 = inner.sample(wo, u1, u2)

  /** Masking alone over its cosine, up to a factor: 1/(cos θ (1 + Λ)). */
  private def seen(w: Vec3): Float =
    val both = Math.abs(w.z) +
      sqrt(square(alphaX * w.x) + square(alphaY * w.y) + w.z * w.z)
    if both > 0f then 1f / both else 0f

  def visibility(wo: Vec3, wi: Vec3, m: Vec3): Float = seen(wo) * seen(wi)

  def sampleWeight(wo: Vec3, wi: Vec3, m: Vec3): Float = 2f * Math.abs(wi.z) * seen(wi)

/** The normals of Disney's clear coat: a distribution of longer tails than that of
  * [[TrowbridgeReitz]], with the masking of another of fixed roughness.
  *
  * @param alpha roughness, in (0, 1)
  *
  * Source: Burley 2012, appendix B (GTR with γ = 1).
  */
final class ClearcoatDistribution(alpha: Float) extends MicrofacetDistribution:
  import ClearcoatDistribution.MaskingAlpha2
  private val alpha2 = alpha.toDouble * alpha
  private val area = (alpha2 - 1.0) / (Math.PI * Math.log(alpha2))

  def isSmooth: Boolean = false

  def d(m: Vec3): Float =
    // 1 − (1 − α²) cos²θ without the loss of digits near the normal
    val sine2 = m.x.toDouble * m.x + m.y.toDouble * m.y
    (area / (sine2 + alpha2 * m.z * m.z)).toFloat

  private def seen(w: Vec3): Float =
    val cosine = Math.abs(w.z)
    1f / (cosine + sqrt(MaskingAlpha2 + cosine * cosine * (1f - MaskingAlpha2)))

  def visibility(wo: Vec3, wi: Vec3, m: Vec3): Float = 0.25f * seen(wo) * seen(wi)

  def pdf(wo: Vec3, m: Vec3): Float = d(m) * m.z

  def sample(wo: Vec3, u1: Float, u2: Float): Vec3 =
    // sin²θ, of which the cosine is found, not the other way round: most are tiny
    val sine2 = (Math.pow(alpha2, 1.0 - u2) - alpha2) / (1.0 - alpha2)
    val sine = Math.sqrt(Math.max(0.0, sine2))
    val phi = 2.0 * Math.PI * u1
    Vec3(
      (sine * Math.cos(phi)).toFloat,
      (sine * Math.sin(phi)).toFloat,
      Math.sqrt(Math.max(0.0, 1.0 - sine2)).toFloat
    )

  def sampleWeight(wo: Vec3, wi: Vec3, m: Vec3): Float =
    if m.z > 0f then 4f * Math.abs(wi.z) * visibility(wo, wi, m) * Math.abs(wo dot m) / m.z else 0f

object ClearcoatDistribution:
  private inline val MaskingAlpha2 = 0.0625f
