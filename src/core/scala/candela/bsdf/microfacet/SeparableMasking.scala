package candela.bsdf.microfacet

import candela.math.*

/** [[TrowbridgeReitz]] with uncorrelated masking and shadowing, as in Disney's material and in
  * Mitsuba.
  */
final class SeparableTrowbridgeReitz(alphaX: Float, alphaY: Float) extends MicrofacetDistribution:
  private val inner = TrowbridgeReitz(alphaX, alphaY)

  def isSmooth: Boolean = false
  def isNarrow: Boolean = inner.isNarrow
  def isIsotropic: Boolean = alphaX == alphaY
  def d(m: Vec3): Float = inner.d(m)
  def pdf(wo: Vec3, m: Vec3): Float = inner.pdf(wo, m)
  def sample(wo: Vec3, u1: Float, u2: Float): Vec3 = inner.sample(wo, u1, u2)

  /** Masking G₁ over its cosine, up to a factor: 1/(cos θ (1 + Λ)). */
  private def masked(w: Vec3): Float =
    val denominator = Math.abs(w.z) +
      sqrt(square(alphaX * w.x) + square(alphaY * w.y) + w.z * w.z)
    if denominator > 0f then 1f / denominator else 0f

  def visibility(wo: Vec3, wi: Vec3, m: Vec3): Float = masked(wo) * masked(wi)

  def sampleWeight(wo: Vec3, wi: Vec3, m: Vec3): Float = 2f * Math.abs(wi.z) * masked(wi)

/** Distributions whose uncorrelated masking and shadowing is that of Gaussian slopes.
  *
  * Samples the visible normals of [[TrowbridgeReitz]], whose density is at most 4/e times smaller.
  *
  * Source: Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007,
  * whose fit of the masking is off by at most 0.35 %.
  */
abstract class GaussianMasking(alphaX: Float, alphaY: Float) extends MicrofacetDistribution:
  import GaussianMasking.Unmasked
  private val visible = TrowbridgeReitz(alphaX, alphaY)
  protected final val ax = Math.max(alphaX, TrowbridgeReitz.MinAlpha)
  protected final val ay = Math.max(alphaY, TrowbridgeReitz.MinAlpha)

  def isSmooth: Boolean = false
  def isNarrow: Boolean = visible.isNarrow
  def isIsotropic: Boolean = alphaX == alphaY

  /** Fraction of the microfacets that `w` sees. */
  private def masked(w: Vec3): Float =
    val across = sqrt(square(ax * w.x) + square(ay * w.y))
    val along = Math.abs(w.z)
    if along >= Unmasked * across then 1f
    else
      val a = along / across
      a * (3.535f + 2.181f * a) / (1f + a * (2.276f + 2.577f * a))

  def visibility(wo: Vec3, wi: Vec3, m: Vec3): Float =
    val cosines = Math.abs(wo.z * wi.z)
    if cosines > 0f then masked(wo) * masked(wi) / (4f * cosines) else 0f

  def pdf(wo: Vec3, m: Vec3): Float = visible.pdf(wo, m)
  def sample(wo: Vec3, u1: Float, u2: Float): Vec3 = visible.sample(wo, u1, u2)

  def sampleWeight(wo: Vec3, wi: Vec3, m: Vec3): Float =
    val density = pdf(wo, m) * Math.abs(wo.z)
    if density > 0f then d(m) * masked(wo) * masked(wi) * Math.abs(wo dot m) / density else 0f

  override def regularized: MicrofacetDistribution =
    val wide = visible.regularized
    if wide eq visible then this else ofRoughness(wide.alphaX, wide.alphaY)

  /** The distribution of another roughness. */
  protected def ofRoughness(alphaX: Float, alphaY: Float): MicrofacetDistribution

/** Beckmann's distribution, of Gaussian slopes.
  *
  * Source: Beckmann and Spizzichino, "The Scattering of Electromagnetic Waves from Rough Surfaces",
  * 1963.
  */
final class Beckmann(alphaX: Float, alphaY: Float) extends GaussianMasking(alphaX, alphaY):
  def d(m: Vec3): Float =
    val cos2 = m.z * m.z
    if cos2 < 1e-8f then 0f
    else exp(-(square(m.x / ax) + square(m.y / ay)) / cos2) / (Pi * ax * ay * cos2 * cos2)

  protected def ofRoughness(alphaX: Float, alphaY: Float): MicrofacetDistribution =
    Beckmann(alphaX, alphaY)

/** Powers of the cosine, with the exponents that make the peak as high as that of [[Beckmann]]: the
  * distribution `phong` or `as` of Mitsuba 0.6.
  *
  * Source: Ashikhmin and Shirley, "An Anisotropic Phong BRDF Model", Journal of Graphics Tools
  * 5(2), 2000; Walter et al. 2007, §5.2, for the exponents.
  */
final class CosineFacets(alphaX: Float, alphaY: Float) extends GaussianMasking(alphaX, alphaY):
  private val ex = CosineFacets.exponent(ax)
  private val ey = CosineFacets.exponent(ay)
  private val peak = Math.sqrt((ex + 2.0) * (ey + 2.0)) / (2.0 * Math.PI)

  def d(m: Vec3): Float =
    val (x2, y2) = (m.x.toDouble * m.x, m.y.toDouble * m.y)
    val s2 = x2 + y2
    if s2 <= 0.0 then peak.toFloat
    else if s2 >= 1.0 then 0f
    else
      val density = peak * Math.exp(0.5 * (ex * x2 + ey * y2) / s2 * Math.log1p(-s2))
      if density > CosineFacets.MinDensity then density.toFloat else 0f

  protected def ofRoughness(alphaX: Float, alphaY: Float): MicrofacetDistribution =
    CosineFacets(alphaX, alphaY)

private object CosineFacets:
  /** Smaller densities lose digits as Floats. */
  val MinDensity = 1e-30

  def exponent(alpha: Float): Double = Math.max(2.0 / (alpha.toDouble * alpha) - 2.0, 0.0)

private object GaussianMasking:
  /** Cotangent, in units of the roughness, above which nothing is masked. */
  private inline val Unmasked = 1.6f
