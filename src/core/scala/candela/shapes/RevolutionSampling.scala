package candela.shapes

import candela.math.*
import candela.sampling.Distribution1D

/** Samples a transformed surface of revolution, nearly uniformly by area before the transform:
  * uniformly in φ, and in z by the areas of [[RevolutionSampling.Rings]] rings.
  *
  * The gradient g = (x, y, −slope) of half the implicit function yields areas: on the untransformed
  * surface dA = |g| dz dφ, and in world space dA = |det M| · |M⁻ᵀ g| dz dφ.
  */
private[shapes] final class RevolutionSampling(
    objectToWorld: Transform,
    profile: Profile,
    phiMax: Float
):
  import RevolutionSampling.*

  private val span = profile.zMax - profile.zMin
  private val determinant = Math.abs(objectToWorld.determinant)

  private val rings = Distribution1D(Array.tabulate(Rings): i =>
    Gauss.map(x => gradientLength((i + x) / Rings)).sum.toFloat)

  private def gradientLength(fraction: Double): Double =
    val z = profile.zMin + fraction * span
    val radius2 = profile.radius2(z)
    val s = profile.slope(z)
    if radius2 > 0 then Math.sqrt(radius2 + s * s) else 0.0

  /** dA / (dz dφ) in world space. */
  private def stretch(x: Double, y: Double, z: Double): Double =
    val m = objectToWorld.inverseM
    val s = -profile.slope(z)
    val nx = m(0) * x + m(4) * y + m(8) * s
    val ny = m(1) * x + m(5) * y + m(9) * s
    val nz = m(2) * x + m(6) * y + m(10) * s
    determinant * Math.sqrt(nx * nx + ny * ny + nz * nz)

  /** World-space area, by quadrature, to six digits or more. */
  lazy val area: Double =
    var sum = 0.0
    for i <- 0 until Rings; x <- Gauss do
      val z = profile.zMin + (i + x) / Rings * span
      val radius2 = profile.radius2(z)
      if radius2 > 0 then
        val r = Math.sqrt(radius2)
        for k <- 0 until Rings; y <- Gauss do
          val phi = profile.seam(z) + (k + y) / Rings * phiMax
          sum += stretch(r * Math.cos(phi), r * Math.sin(phi), z)
    sum * span * phiMax / (4.0 * Rings * Rings)

  /** `out.n` is the gradient's direction, `out.pdf` is per world area. */
  def sample(u1: Float, u2: Float, out: SurfaceSample): Unit =
    val fraction = rings.sample(u1)
    // In Double up to the world point: `pError` covers its rounding only
    val z = profile.zMin + fraction * span
    val r = Math.sqrt(Math.max(0.0, profile.radius2(z)))
    val phi = profile.seam(z) + u2.toDouble * phiMax
    val x = r * Math.cos(phi)
    val y = r * Math.sin(phi)
    out.p = SurfaceOfRevolution.mapPoint(objectToWorld.m, x, y, z)
    out.pError = TriangleSoup.roundingError(out.p)
    out.n = objectToWorld
      .normal(Vec3(x.toFloat, y.toFloat, -profile.slope(z).toFloat))
      .normalized
    out.pdf = density(rings.pdf(fraction), x, y, z)

  /** Pdf per world area with which `sample` returns the point p. */
  def perArea(p: Vec3): Float =
    val m = objectToWorld.inverseM
    val x = m(0) * p.x + m(1) * p.y + m(2) * p.z + m(3)
    val y = m(4) * p.x + m(5) * p.y + m(6) * p.z + m(7)
    val z = m(8) * p.x + m(9) * p.y + m(10) * p.z + m(11)
    val fraction = Math.max(0.0, Math.min(1.0, (z - profile.zMin) / span))
    density(rings.pdf(fraction.toFloat), x, y, z)

  private def density(perPart: Float, x: Double, y: Double, z: Double): Float =
    (perPart / (span * phiMax * stretch(x, y, z))).toFloat

private[shapes] object RevolutionSampling:
  val Rings = 64

  /** Abscissae of the two-point Gauss rule on [0, 1]. */
  private val Gauss = Seq(0.5 - 0.5 / Math.sqrt(3.0), 0.5 + 0.5 / Math.sqrt(3.0))
