package candela.bsdf.microfacet

import candela.bsdf.BsdfFlags
import candela.math.*
import candela.sampling.Warp

/** A microfacet normal distribution with its masking-shadowing function.
  *
  * `m` is a unit microfacet normal with `m.z` > 0. Only the absolute cosines of `wo` and `wi`
  * matter: the distribution is the same from below.
  *
  * Source of the names: Walter et al., "Microfacet Models for Refraction through Rough Surfaces",
  * EGSR 2007.
  */
abstract class MicrofacetDistribution:

  /** The normal distribution function: area of microfacets with normal `m`, per unit of surface
    * area and solid angle of normals.
    */
  def d(m: Vec3): Float

  /** G / (4 |cos θo cos θi|), where G is masking-shadowing, in a form that stays finite at grazing
    * angles wherever the model does.
    */
  def visibility(wo: Vec3, wi: Vec3, m: Vec3): Float

  /** The pdf with which `sample` returns `m`, per solid angle of normals. */
  def pdf(wo: Vec3, m: Vec3): Float

  /** Samples a normal for a `wo` with `wo.z` ≥ 0; not all models guarantee that it faces `wo`. */
  def sample(wo: Vec3, u1: Float, u2: Float): Vec3

  /** d · G · (wo·m) / (|cos θo| · pdf): f·cos/pdf for a sampled microfacet that reflects or
    * refracts `wo` to `wi` without loss.
    */
  def sampleWeight(wo: Vec3, wi: Vec3, m: Vec3): Float

  /** Whether to treat the surface as perfectly specular. */
  def isSmooth: Boolean

  /** Is light scattered to so narrow a range of directions that curved surfaces focus it? */
  def isNarrow: Boolean

  /** Flags of a BSDF of such microfacets. */
  final def flags: BsdfFlags =
    if isNarrow then BsdfFlags.Glossy | BsdfFlags.Narrow else BsdfFlags.Glossy

  /** Whether the roughness is the same along x and y. */
  def isIsotropic: Boolean

  /** The distribution of [[Bsdf.regularized]]. Distributions that exist only in older versions of
    * PBRT are unchanged: their integrators don't regularise.
    */
  def regularized: MicrofacetDistribution = this

/** The Trowbridge–Reitz (GGX) distribution, of an ellipsoid: a narrow peak with long tails.
  *
  * Height-correlated Smith masking-shadowing. Samples visible normals.
  *
  * @param alphaX roughness along x (∂p/∂u): the root mean square slope of the core, unitless
  * @param alphaY roughness along y
  *
  * Sources: Trowbridge and Reitz, "Average irregularity representation of a rough surface for ray
  * reflection", JOSA 65, 1975; Heitz, "Understanding the Masking-Shadowing Function in
  * Microfacet-Based BRDFs", JCGT 3(2), 2014; Dupuy and Benyoub, "Sampling Visible GGX Normals with
  * Spherical Caps", HPG 2023.
  */
final class TrowbridgeReitz(val alphaX: Float, val alphaY: Float) extends MicrofacetDistribution:

  def isIsotropic: Boolean = alphaX == alphaY

  val isSmooth: Boolean = Math.max(alphaX, alphaY) < TrowbridgeReitz.SmoothBelow
  def isNarrow: Boolean = Math.min(alphaX, alphaY) < TrowbridgeReitz.Wide

  /** Doubles the roughness, clamped to [0.1, 0.3]; unchanged from 0.3 on (PBRT 4th ed., §13.4.1).
    */
  override def regularized: TrowbridgeReitz =
    if alphaX >= TrowbridgeReitz.Regular && alphaY >= TrowbridgeReitz.Regular then this
    else TrowbridgeReitz(TrowbridgeReitz.widened(alphaX), TrowbridgeReitz.widened(alphaY))

  // Roughness in one direction requires a minimum in the other, to keep d finite.
  private val ax = Math.max(alphaX, TrowbridgeReitz.MinAlpha)
  private val ay = Math.max(alphaY, TrowbridgeReitz.MinAlpha)

  def d(m: Vec3): Float =
    val e = square(m.x / ax) + square(m.y / ay) + m.z * m.z
    1f / (Pi * ax * ay * e * e)

  /** Length of `w` in the space where the ellipsoid is a sphere: 1 + 2Λ is this over |cos θ|. */
  private def stretched(w: Vec3): Float =
    sqrt(square(ax * w.x) + square(ay * w.y) + w.z * w.z)

  def visibility(wo: Vec3, wi: Vec3, m: Vec3): Float =
    val denominator = Math.abs(wi.z) * stretched(wo) + Math.abs(wo.z) * stretched(wi)
    if denominator > 0f then 0.5f / denominator else 0f

  def pdf(wo: Vec3, m: Vec3): Float =
    val denominator = Math.abs(wo.z) + stretched(wo)
    d(m) * 2f * Math.max(0f, wo dot m) / denominator

  def sample(wo: Vec3, u1: Float, u2: Float): Vec3 =
    val view = Vec3(ax * wo.x, ay * wo.y, wo.z).normalized
    val sumZ = (1f - u2) * (1f + view.z)
    val z = sumZ - view.z
    val r = safeSqrt(1f - z * z)
    val circle = Warp.spherical(sumZ, r, u1)
    Vec3(ax * (circle.x + view.x), ay * (circle.y + view.y), sumZ).normalized

  def sampleWeight(wo: Vec3, wi: Vec3, m: Vec3): Float =
    val cosO = Math.abs(wo.z)
    val cosI = Math.abs(wi.z)
    val o = stretched(wo)
    val denominator = cosI * o + cosO * stretched(wi)
    if denominator > 0f then cosI * (cosO + o) / denominator else 0f

object TrowbridgeReitz:

  /** The distribution of a regularised smooth surface. */
  val RegularizedMirror: TrowbridgeReitz = TrowbridgeReitz(0f, 0f).regularized

  /** Minimum roughness that regularisation leaves unchanged. */
  private inline val Regular = 0.3f

  private def widened(alpha: Float): Float =
    if alpha < Regular then clamp(2f * alpha, 0.1f, Regular) else alpha

  /** Roughness below which PBRT 4 treats a surface as perfectly smooth. */
  inline val SmoothBelow = 1e-3f

  /** Roughness from which on surfaces blur what they focus: half of the light leaves in a cone of
    * 50° or more.
    */
  private[microfacet] inline val Wide = 0.25f

  /** Minimum roughness along one axis of a surface that is rough along the other. */
  inline val MinAlpha = 1e-4f

/** Blinn microfacet distribution (cosine power) and its anisotropic form.
  *
  * V-groove masking-shadowing (Torrance and Sparrow). Normals are sampled independently of `wo`;
  * those that face away from it are lost.
  *
  * @param exponentX along x (∂p/∂u), at least 0; higher is smoother
  * @param exponentY along y
  *
  * Sources: Blinn, "Models of Light Reflection for Computer Synthesized Pictures", SIGGRAPH 1977;
  * Ashikhmin and Shirley, "An Anisotropic Phong BRDF Model", Journal of Graphics Tools 5(2), 2000;
  * normalised as in PBRT 2nd ed., §8.4.
  */
final class CosinePower(exponentX: Float, exponentY: Float) extends MicrofacetDistribution:

  // Double: (1 − sin²θ)^(e/2) with an exponent of 10⁴ would lose all but 3 digits of a Float.
  private val ex = CosinePower.bounded(exponentX).toDouble
  private val ey = CosinePower.bounded(exponentY).toDouble
  private val area = Math.sqrt((ex + 2.0) * (ey + 2.0)) / (2.0 * Math.PI)
  private val count = Math.sqrt((ex + 1.0) * (ey + 1.0)) / (2.0 * Math.PI)
  private val areaPerCount = (area / count).toFloat

  def isSmooth: Boolean = false
  def isIsotropic: Boolean = ex == ey

  /** By the roughness of equal core width, √(2/(e + 2)). */
  def isNarrow: Boolean = Math.max(ex, ey) > 2.0 / square(TrowbridgeReitz.Wide) - 2.0

  def d(m: Vec3): Float = (area * power(m)).toFloat

  /** cosθ to the power of the exponent at the azimuth of `m`. */
  private def power(m: Vec3): Double =
    val x2 = m.x.toDouble * m.x
    val y2 = m.y.toDouble * m.y
    val s2 = x2 + y2
    if s2 <= 0.0 then 1.0
    else if s2 >= 1.0 then 0.0
    else Math.pow(1.0 - s2, 0.5 * (if ex == ey then ex else (ex * x2 + ey * y2) / s2))

  def visibility(wo: Vec3, wi: Vec3, m: Vec3): Float =
    val cosO = Math.abs(wo.z)
    val cosI = Math.abs(wi.z)
    val cosM = Math.abs(wo dot m)
    if cosO == 0f || cosI == 0f || cosM == 0f then 0f
    else
      val lit = Math.min(cosO, cosI) * 2f * m.z / cosM
      Math.min(1f, lit) / (4f * cosO * cosI)

  def pdf(wo: Vec3, m: Vec3): Float = (count * power(m)).toFloat

  def sample(wo: Vec3, u1: Float, u2: Float): Vec3 =
    val circle = Warp.spherical(0f, 1f, u1)
    val x = Math.sqrt(ey + 1.0) * circle.x
    val y = Math.sqrt(ex + 1.0) * circle.y
    val length2 = x * x + y * y
    val exponent = (ex * x * x + ey * y * y) / length2
    // 1 − u2 is never 0, so neither is the cosine.
    val cos2 = Math.pow(1.0 - u2, 2.0 / (exponent + 1.0))
    val r = Math.sqrt(Math.max(0.0, 1.0 - cos2) / length2)
    Vec3((r * x).toFloat, (r * y).toFloat, Math.sqrt(cos2).toFloat)

  def sampleWeight(wo: Vec3, wi: Vec3, m: Vec3): Float =
    4f * areaPerCount * visibility(wo, wi, m) * Math.abs(wo dot m) * Math.abs(wi.z)

object CosinePower:

  /** The isotropic form: Blinn's distribution. */
  def apply(exponent: Float): CosinePower = new CosinePower(exponent, exponent)

  /** Upper clamp of the exponent, used for a roughness of 0. */
  inline val Highest = 10000f

  private def bounded(exponent: Float): Float =
    if exponent <= Highest then Math.max(exponent, 0f) else Highest // NaN clamps to it, too
