package candela.shapes

import candela.geometry.{Bounds3, Hit, Ray, ShadingPoint}
import candela.math.*
import candela.sampling.{SphericalTriangle, Warp}

/** Samples a triangle of the soup uniformly by solid angle, so that distance and slant add no
  * noise; by area if the solid angle is so small that both are the same, or so large that the
  * reference point is almost on the triangle.
  *
  * Sources: [[SphericalTriangle]]; by area Heitz, "A Low-Distortion Map Between Triangle and
  * Square", 2019.
  *
  * @param isInverted whether its normals are opposite to those that rays see
  */
final class TriangleSampler(soup: TriangleSoup, triangle: Int, isInverted: Boolean = false)
    extends SurfaceSampler:
  private val p0 = soup.vertex(triangle, 0)
  private val p1 = soup.vertex(triangle, 1)
  private val p2 = soup.vertex(triangle, 2)
  private val cross = (p1 - p0) cross (p2 - p0)
  val area: Float = 0.5f * cross.length

  /** Outward unit normal, as [[TriangleSoup.surface]] orients it at the centroid; or its opposite.
    */
  val normal: Vec3 =
    val centroid = candela.geometry.ShadingPoint()
    val hit = candela.geometry.Hit()
    hit.u = 1.0 / 3
    hit.v = 1.0 / 3
    soup.surface(triangle, hit, centroid)
    if isInverted then -centroid.geometricNormal else centroid.geometricNormal

  // Of the vertex normals to `normal`, whose sides are those that rays see
  private val cosines =
    val all = soup.vertexCosines(triangle, normal)
    if isInverted then -all else all

  /** Whether the vertex normals lie on both sides: then [[TriangleSoup.surface]] orients normals
    * point by point.
    */
  val isTwisted: Boolean =
    Math.min(cosines.x, Math.min(cosines.y, cosines.z)) < 0f &&
      Math.max(cosines.x, Math.max(cosines.y, cosines.z)) > 0f

  def vertices: Seq[Vec3] = Seq(p0, p1, p2)
  val bounds: Bounds3 = Bounds3.of(vertices)

  override def sample(from: Vec3, u1: Float, u2: Float, out: SurfaceSample): Unit =
    val angle = out.triangle.set(from, p0, p1, p2)
    if SurfaceSampler.isByAngle(angle) then
      setPoint(from, out.triangle.sample(u1, u2), out)
      out.pdf = (1 / angle).toFloat
    else
      placeByArea(u1, u2, out)
      out.pdf = SurfaceSampler.perSolidAngle(1f / area, from, out.p, normal)
    out.pError = TriangleSoup.error(out.p, p0, p1, p2)

  override def pdf(from: Vec3, p: Vec3, n: Vec3): Float =
    val angle = SphericalTriangle.solidAngle(from, p0, p1, p2)
    if SurfaceSampler.isByAngle(angle) then (1 / angle).toFloat
    else SurfaceSampler.perSolidAngle(1f / area, from, p, normal)

  def sampleArea(u1: Float, u2: Float, out: SurfaceSample): Unit =
    placeByArea(u1, u2, out)
    out.pError = TriangleSoup.error(out.p, p0, p1, p2)
    out.pdf = 1f / area

  def areaPdf(p: Vec3): Float = 1f / area

  private lazy val corners = Array(p0.x, p0.y, p0.z, p1.x, p1.y, p1.z, p2.x, p2.y, p2.z)

  def intersectSurface(ray: Ray, hit: Hit, at: ShadingPoint): Boolean =
    val isMet = TriangleTest.intersect(corners, 0, ray, hit)
    if isMet then soup.surface(triangle, hit, at)
    isMet

  /** Intersects the ray from `from` in direction `w` with the triangle, as barycentric weights that
    * keep the point on it despite rounding.
    */
  private def setPoint(from: Vec3, w: Vec3, out: SurfaceSample): Unit =
    val e1x = p1.x.toDouble - p0.x
    val e1y = p1.y.toDouble - p0.y
    val e1z = p1.z.toDouble - p0.z
    val e2x = p2.x.toDouble - p0.x
    val e2y = p2.y.toDouble - p0.y
    val e2z = p2.z.toDouble - p0.z
    val qx = w.y * e2z - w.z * e2y
    val qy = w.z * e2x - w.x * e2z
    val qz = w.x * e2y - w.y * e2x
    val sx = from.x.toDouble - p0.x
    val sy = from.y.toDouble - p0.y
    val sz = from.z.toDouble - p0.z
    val inverse = 1 / (e1x * qx + e1y * qy + e1z * qz)
    val b1 = Math.max(0.0, Math.min(1.0, (sx * qx + sy * qy + sz * qz) * inverse))
    val rx = sy * e1z - sz * e1y
    val ry = sz * e1x - sx * e1z
    val rz = sx * e1y - sy * e1x
    val b2 = Math.max(0.0, Math.min(1.0 - b1, (w.x * rx + w.y * ry + w.z * rz) * inverse))
    combine(1.0 - b1 - b2, b1, b2, out)

  private def placeByArea(u1: Float, u2: Float, out: SurfaceSample): Unit =
    val b = Warp.uniformTriangle(u1, u2)
    combine(b.x.toDouble, b.y.toDouble, 1.0 - b.x - b.y, out)

  private def combine(b0: Double, b1: Double, b2: Double, out: SurfaceSample): Unit =
    out.p = Vec3(
      (b0 * p0.x + b1 * p1.x + b2 * p2.x).toFloat,
      (b0 * p0.y + b1 * p1.y + b2 * p2.y).toFloat,
      (b0 * p0.z + b1 * p1.z + b2 * p2.z).toFloat
    )
    val isAway = isTwisted && b0 * cosines.x + b1 * cosines.y + b2 * cosines.z < 0.0
    out.n = if isAway then -normal else normal
