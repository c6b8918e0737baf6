package candela.bsdf

import candela.math.*

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
