package candela.shapes

import candela.geometry.{Bounds3, Hit, Ray, ShadingPoint}
import candela.math.*
import candela.sampling.SphericalRectangle

/** Samples two triangles of the soup that form a rectangle: uniformly by solid angle if it is
  * large, so that distance and slant add no noise; else by area, which is nearly the same and takes
  * a fraction of the time.
  *
  * @param first  one of the triangles; its normal is that of the rectangle
  * @param second the other one
  *
  * Source: [[SphericalRectangle]].
  */
final class RectangleSampler(
    corners: RectangleSampler.Corners,
    first: TriangleSampler,
    second: TriangleSampler
) extends SurfaceSampler:
  import RectangleSampler.*
  import corners.*

  val normal: Vec3 = first.normal
  private val edgeX = b - a
  private val edgeY = d - a
  private val width = edgeX.length
  private val height = edgeY.length
  private val axisX = edgeX * (1f / width)
  private val axisY = edgeY * (1f / height)
  private val axisZ = axisX cross axisY
  private val center = (a + c) * 0.5f
  val area: Float = width * height

  def vertices: Seq[Vec3] = Seq(a, b, c, d)
  val bounds: Bounds3 = Bounds3.of(vertices)

  override def sample(from: Vec3, u1: Float, u2: Float, out: SurfaceSample): Unit =
    var angle = 0.0
    if isLarge(from) then
      val x0 = alongX(from)
      val y0 = alongY(from)
      angle = out.rectangle.set(x0, x0 + width, y0, y0 + height, alongZ(from))
      if SurfaceSampler.isByAngle(angle) then
        out.rectangle.sample(u1, u2)
        setPoint((out.rectangle.x - x0) / width, (out.rectangle.y - y0) / height, out)
        out.pdf = (1 / angle).toFloat
    if !SurfaceSampler.isByAngle(angle) then
      sampleArea(u1, u2, out)
      out.pdf = SurfaceSampler.perSolidAngle(1f / area, from, out.p, normal)

  override def pdf(from: Vec3, p: Vec3, n: Vec3): Float =
    var angle = 0.0
    if isLarge(from) then
      val x0 = alongX(from)
      val y0 = alongY(from)
      angle = SphericalRectangle.solidAngle(x0, x0 + width, y0, y0 + height, alongZ(from))
    if SurfaceSampler.isByAngle(angle) then (1 / angle).toFloat
    else SurfaceSampler.perSolidAngle(1f / area, from, p, normal)

  def sampleArea(u1: Float, u2: Float, out: SurfaceSample): Unit =
    setPoint(u1, u2, out)
    out.pdf = 1f / area

  def areaPdf(p: Vec3): Float = 1f / area

  def intersectSurface(ray: Ray, hit: Hit, at: ShadingPoint): Boolean =
    first.intersectSurface(ray, hit, at) || second.intersectSurface(ray, hit, at)

  private def isLarge(from: Vec3): Boolean = area > Large * (center - from).lengthSquared

  // From `from` to the corner, in the axes of the rectangle
  private def alongX(from: Vec3): Double = along(axisX, from)
  private def alongY(from: Vec3): Double = along(axisY, from)
  private def alongZ(from: Vec3): Double = along(axisZ, from)
  private def along(axis: Vec3, from: Vec3): Double =
    (a.x.toDouble - from.x) * axis.x + (a.y.toDouble - from.y) * axis.y +
      (a.z.toDouble - from.z) * axis.z

  /** Bilinear between the corners, so that the point keeps to the triangles despite rounding. */
  private def setPoint(s: Double, t: Double, out: SurfaceSample): Unit =
    val wa = (1 - s) * (1 - t)
    val wb = s * (1 - t)
    val wc = s * t
    val wd = (1 - s) * t
    out.p = Vec3(
      (wa * a.x + wb * b.x + wc * c.x + wd * d.x).toFloat,
      (wa * a.y + wb * b.y + wc * c.y + wd * d.y).toFloat,
      (wa * a.z + wb * b.z + wc * c.z + wd * d.z).toFloat
    )
    out.n = normal
    out.pError = error

  // That of rounding, and how far the corners may be from one plane
  private val error =
    def of(k: Int) = vertices.map(v => Math.abs(v(k))).max * (gamma(2) + 2 * Tolerance)
    Vec3(of(0), of(1), of(2))

object RectangleSampler:
  /** Corners in order around the rectangle. */
  final class Corners(val a: Vec3, val b: Vec3, val c: Vec3, val d: Vec3)

  /** Area over squared distance, above which sampling by solid angle pays. */
  private inline val Large = 0.1f

  /** Rounding of coordinates, relative to the largest. */
  private inline val Tolerance = 2.4e-7f

  /** Cosine of an angle that counts as a right one. */
  private inline val RightAngle = 1e-5f

  /** The rectangle that two triangles form, given by their corners; None if they don't. */
  def of(p: IndexedSeq[Vec3], q: IndexedSeq[Vec3]): Option[Corners] =
    val shared = p.filter(q.contains)
    for
      a <- p.find(!shared.contains(_)) if shared.size == 2
      c <- q.find(!shared.contains(_))
      corners = Corners(a, shared(0), c, shared(1)) if isRectangle(corners)
      if (turns(p) dot turns(q)) > 0f
    yield corners

  private def turns(p: IndexedSeq[Vec3]): Vec3 = (p(1) - p(0)) cross (p(2) - p(0))

  private def isRectangle(r: Corners): Boolean =
    import r.*
    val largest = Seq(a, b, c, d).flatMap(v => Seq(v.x, v.y, v.z)).map(Math.abs(_)).max
    val gap = (a + c) - (b + d)
    val (x, y) = (b - a, d - a)
    val isClosed = Seq(gap.x, gap.y, gap.z).forall(Math.abs(_) <= 2 * Tolerance * largest)
    isClosed && x.length > 0f && y.length > 0f &&
    Math.abs(x dot y) <= RightAngle * x.length * y.length
