package candela.shapes

import candela.math.*

/** Points on one triangle of the soup, uniform by area.
  *
  * Source of the map: Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
  */
final class TriangleSampler(soup: TriangleSoup, triangle: Int) extends SurfaceSampler:
  private val p0 = soup.vertex(triangle, 0)
  private val p1 = soup.vertex(triangle, 1)
  private val p2 = soup.vertex(triangle, 2)
  private val cross = (p1 - p0) cross (p2 - p0)
  val area: Float = 0.5f * cross.length

  /** Unit normal on the outside, as [[TriangleSoup.surface]] orients it at the centroid. */
  val normal: Vec3 =
    val at = candela.geometry.ShadingPoint()
    val hit = candela.geometry.Hit()
    hit.u = 1f / 3f
    hit.v = 1f / 3f
    soup.surface(triangle, hit, at)
    at.geometricNormal

  def vertices: Seq[Vec3] = Seq(p0, p1, p2)

  def sample(from: Vec3, u1: Float, u2: Float, out: SurfaceSample): Unit =
    val b0 = if u1 < u2 then u1 * 0.5f else u1 - u2 * 0.5f
    val b1 = if u1 < u2 then u2 - u1 * 0.5f else u2 * 0.5f
    val b2 = 1.0 - b0 - b1
    out.p = Vec3(
      (b0 * p0.x.toDouble + b1 * p1.x.toDouble + b2 * p2.x).toFloat,
      (b0 * p0.y.toDouble + b1 * p1.y.toDouble + b2 * p2.y).toFloat,
      (b0 * p0.z.toDouble + b1 * p1.z.toDouble + b2 * p2.z).toFloat
    )
    out.pError = TriangleSoup.roundingError(out.p)
    out.n = normal
    out.pdf = SurfaceSampler.perSolidAngle(1f / area, from, out.p, normal)

  def pdf(from: Vec3, p: Vec3, n: Vec3): Float =
    SurfaceSampler.perSolidAngle(1f / area, from, p, normal)
