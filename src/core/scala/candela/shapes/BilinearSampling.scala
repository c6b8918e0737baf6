package candela.shapes

import candela.math.*

/** Samples a bilinear patch nearly uniformly by area: the pdf of u and v is bilinear and exact at
  * the corners. Uniform for parallelograms.
  *
  * Source: Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., §6.6.2.
  */
private[shapes] final class BilinearSampling(corners: BilinearPatch.Corners):
  import corners.*

  private val w00 = weight(0f, 0f)
  private val w10 = weight(1f, 0f)
  private val w01 = weight(0f, 1f)
  private val w11 = weight(1f, 1f)
  private val mean = (w00 + w10 + w01 + w11) / 4f

  /** dA / (du dv) */
  private def weight(u: Float, v: Float): Float = (alongU(v) cross alongV(u)).length

  /** By the three-point Gauss rule in both directions. */
  val area: Float =
    val nodes = BilinearSampling.Gauss
    (for (u, a) <- nodes; (v, b) <- nodes yield a * b * weight(u, v)).sum

  /** `orient` orients the geometric normal at (u, v) outwards; `out.pdf` is per area. */
  def sample(u1: Float, u2: Float)(
      orient: (Float, Float, Vec3) => Vec3
  )(out: SurfaceSample): Unit =
    // First v by its marginal pdf, then u given v
    val v = BilinearSampling.linear(u2, w00 + w10, w01 + w11)
    val u = BilinearSampling.linear(u1, lerp(v, w00, w01), lerp(v, w10, w11))
    out.p = point(u, v)
    out.pError = error(out.p)
    val cross = alongU(v) cross alongV(u)
    val length = cross.length
    out.n = orient(u, v, if length > 0f then cross * (1f / length) else Vec3.Z).normalized
    out.pdf = if length > 0f then density(u, v) / length else 0f

  private def density(u: Float, v: Float): Float =
    lerp(v, lerp(u, w00, w10), lerp(u, w01, w11)) / mean

  /** Pdf per area with which `sample` returns the point p. */
  def perArea(p: Vec3): Float =
    var u = 0.5
    var v = 0.5
    // Newton's method on (p(u, v) − p) · ∂p/∂u = 0 and (p(u, v) − p) · ∂p/∂v = 0, without the
    // second derivatives: p is on the patch, so convergence is still quadratic
    var steps = 12
    while steps > 0 do
      val uf = u.toFloat
      val vf = v.toFloat
      val pu = alongU(vf)
      val pv = alongV(uf)
      val d = p - point(uf, vf)
      val e = pu dot pu
      val f = pu dot pv
      val g = pv dot pv
      val determinant = e.toDouble * g - f.toDouble * f
      if determinant > 0 then
        val a = (d dot pu).toDouble
        val b = (d dot pv).toDouble
        u = Math.max(0.0, Math.min(1.0, u + (g * a - f * b) / determinant))
        v = Math.max(0.0, Math.min(1.0, v + (e * b - f * a) / determinant))
      steps -= 1
    val length = weight(u.toFloat, v.toFloat)
    if length > 0f then density(u.toFloat, v.toFloat) / length else 0f

private[shapes] object BilinearSampling:
  /** Abscissae and weights on [0, 1]. */
  private val Gauss: Seq[(Float, Float)] =
    val x = 0.5f * sqrt(0.6f)
    Seq((0.5f - x, 5f / 18), (0.5f, 8f / 18), (0.5f + x, 5f / 18))

  /** Samples x in [0, 1] with an unnormalised pdf that is linear from a to b. */
  private def linear(u: Float, a: Float, b: Float): Float =
    if a + b <= 0f then u
    else
      // The root of the inverse CDF without cancellation
      val root = Math.sqrt((1.0 - u) * a * a + u.toDouble * b * b)
      Math.min(OneMinusEpsilon.toDouble, u * (a.toDouble + b) / (a + root)).toFloat
