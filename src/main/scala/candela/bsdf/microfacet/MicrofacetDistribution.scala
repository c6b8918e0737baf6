package candela.bsdf.microfacet

import candela.math.*

/** How the normals of the tiny mirrors of a rough surface are spread, and how these hide one
  * another.
  *
  * `m` is a unit microfacet normal with `m.z` > 0. Of `wo` and `wi` only the sizes of the cosines
  * count: the distribution looks the same from below.
  *
  * Source of the names: Walter et al., "Microfacet Models for Refraction through Rough Surfaces",
  * EGSR 2007.
  */
abstract class MicrofacetDistribution:

  /** Area of facets with normal `m`, per unit of surface and solid angle of normals. */
  def d(m: Vec3): Float

  /** G / (4 |cos θo cos θi|): the share of the facets of normal `m` that both directions see, in
    * the form that stays finite at grazing angles wherever the model does.
    */
  def visibility(wo: Vec3, wi: Vec3, m: Vec3): Float

  /** The density, per solid angle of normals, with which `sample` returns `m`. */
  def pdf(wo: Vec3, m: Vec3): Float

  /** Draws a normal for a `wo` with `wo.z` ≥ 0; not all models see to it that it faces `wo`. */
  def sample(wo: Vec3, u1: Float, u2: Float): Vec3

  /** d · G · (wo·m) / (|cos θo| · pdf): what is left of f·cos/pdf when a sampled facet reflects or
    * refracts `wo` to `wi` without loss.
    */
  def sampleWeight(wo: Vec3, wi: Vec3, m: Vec3): Float

  /** So smooth that it should be treated as a perfect mirror. */
  def isSmooth: Boolean

  /** That of [[Bsdf.regularized]]. Those which only older versions of PBRT have stay as they are:
    * no integrator of theirs asks.
    */
  def regularized: MicrofacetDistribution = this

/** The normals of an ellipsoid (also called GGX): a narrow peak with long tails.
  *
  * Shadowing and masking after Smith, correlated in height. Normals are sampled in proportion to
  * the area that `wo` sees.
  *
  * @param alphaX roughness along x (∂p/∂u): the root mean square slope of the core, unitless
  * @param alphaY the same along y
  *
  * Sources: Trowbridge and Reitz, "Average irregularity representation of a rough surface for ray
  * reflection", JOSA 65, 1975; Heitz, "Understanding the Masking-Shadowing Function in
  * Microfacet-Based BRDFs", JCGT 3(2), 2014; Dupuy and Benyoub, "Sampling Visible GGX Normals with
  * Spherical Caps", HPG 2023.
  */
final class TrowbridgeReitz(val alphaX: Float, val alphaY: Float) extends MicrofacetDistribution:

  val isSmooth: Boolean = Math.max(alphaX, alphaY) < TrowbridgeReitz.SmoothBelow

  /** Twice as rough, but at least 0.1; from 0.3 on as it is (PBRT 4th ed., §13.4.1). */
  override def regularized: TrowbridgeReitz =
    if alphaX >= TrowbridgeReitz.Regular && alphaY >= TrowbridgeReitz.Regular then this
    else TrowbridgeReitz(TrowbridgeReitz.widened(alphaX), TrowbridgeReitz.widened(alphaY))

  // One rough direction is enough to need the other: keeps d finite.
  private val ax = Math.max(alphaX, TrowbridgeReitz.LeastAlpha)
  private val ay = Math.max(alphaY, TrowbridgeReitz.LeastAlpha)

  def d(m: Vec3): Float =
    val e = square(m.x / ax) + square(m.y / ay) + m.z * m.z
    1f / (Pi * ax * ay * e * e)

  /** Length of `w` in the space where the ellipsoid is a sphere: 1 + 2Λ is this over |cos θ|. */
  private def stretched(w: Vec3): Float =
    sqrt(square(ax * w.x) + square(ay * w.y) + w.z * w.z)

  def visibility(wo: Vec3, wi: Vec3, m: Vec3): Float =
    val both = Math.abs(wi.z) * stretched(wo) + Math.abs(wo.z) * stretched(wi)
    if both > 0f then 0.5f / both else 0f

  def pdf(wo: Vec3, m: Vec3): Float =
    val seen = Math.abs(wo.z) + stretched(wo)
    d(m) * 2f * Math.max(0f, wo dot m) / seen

  def sample(wo: Vec3, u1: Float, u2: Float): Vec3 =
    val view = Vec3(ax * wo.x, ay * wo.y, wo.z).normalized
    val phi = TwoPi * u1
    val up = (1f - u2) * (1f + view.z)
    val z = up - view.z
    val r = safeSqrt(1f - z * z)
    Vec3(ax * (r * cos(phi) + view.x), ay * (r * sin(phi) + view.y), up).normalized

  def sampleWeight(wo: Vec3, wi: Vec3, m: Vec3): Float =
    val cosO = Math.abs(wo.z)
    val cosI = Math.abs(wi.z)
    val o = stretched(wo)
    val both = cosI * o + cosO * stretched(wi)
    if both > 0f then cosI * (cosO + o) / both else 0f

object TrowbridgeReitz:

  /** That of a smooth surface which is regularized. */
  val RegularizedMirror: TrowbridgeReitz = TrowbridgeReitz(0f, 0f).regularized

  /** The least roughness that regularization leaves as it is. */
  private inline val Regular = 0.3f

  private def widened(alpha: Float): Float =
    if alpha < Regular then clamp(2f * alpha, 0.1f, Regular) else alpha

  /** Where PBRT 4 begins to treat a surface as perfectly smooth. */
  inline val SmoothBelow = 1e-3f

  /** The least roughness along one axis of a surface that is rough along the other. */
  inline val LeastAlpha = 1e-4f

/** Normals spread like a power of their cosine: Blinn's distribution and its anisotropic form.
  *
  * Shadowing and masking by V-shaped grooves (Torrance and Sparrow). Normals are sampled without
  * regard to `wo`; those that face away from it are lost.
  *
  * @param exponentX along x (∂p/∂u), at least 0; the surface is the smoother, the higher
  * @param exponentY the same along y
  *
  * Sources: Blinn, "Models of Light Reflection for Computer Synthesized Pictures", SIGGRAPH 1977;
  * Ashikhmin and Shirley, "An Anisotropic Phong BRDF Model", Journal of Graphics Tools 5(2), 2000;
  * normalised as in PBRT 2nd ed., §8.4.
  */
final class CosinePower(exponentX: Float, exponentY: Float) extends MicrofacetDistribution:

  // Double: (1 − sin²θ)^(e/2) with an exponent of 10⁴ would keep 3 digits of a Float.
  private val ex = CosinePower.bounded(exponentX).toDouble
  private val ey = CosinePower.bounded(exponentY).toDouble
  private val area = Math.sqrt((ex + 2.0) * (ey + 2.0)) / (2.0 * Math.PI)
  private val count = Math.sqrt((ex + 1.0) * (ey + 1.0)) / (2.0 * Math.PI)
  private val areaPerCount = (area / count).toFloat

  def isSmooth: Boolean = false

  def d(m: Vec3): Float = (area * power(m)).toFloat

  /** cosθ to the exponent of the azimuth of `m`. */
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
    val angle = 2.0 * Math.PI * u1
    val x = Math.sqrt(ey + 1.0) * Math.cos(angle)
    val y = Math.sqrt(ex + 1.0) * Math.sin(angle)
    val length2 = x * x + y * y
    val exponent = (ex * x * x + ey * y * y) / length2
    // 1 − u2 is never 0, so that the cosine isn't either.
    val cos2 = Math.pow(1.0 - u2, 2.0 / (exponent + 1.0))
    val r = Math.sqrt(Math.max(0.0, 1.0 - cos2) / length2)
    Vec3((r * x).toFloat, (r * y).toFloat, Math.sqrt(cos2).toFloat)

  def sampleWeight(wo: Vec3, wi: Vec3, m: Vec3): Float =
    4f * areaPerCount * visibility(wo, wi, m) * Math.abs(wo dot m) * Math.abs(wi.z)

object CosinePower:

  /** The same in every azimuth: Blinn's distribution. */
  def apply(exponent: Float): CosinePower = new CosinePower(exponent, exponent)

  /** The highest exponent in use, for surfaces that are said to have no roughness at all. */
  inline val Highest = 10000f

  private def bounded(exponent: Float): Float =
    if exponent <= Highest then Math.max(exponent, 0f) else Highest // NaN, too, is the highest
