package candela.bsdf

import candela.color.Rgb
import candela.math.*

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
