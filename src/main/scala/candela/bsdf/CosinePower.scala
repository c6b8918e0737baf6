package candela.bsdf

import candela.math.*

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
