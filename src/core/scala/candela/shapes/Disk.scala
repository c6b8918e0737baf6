package candela.shapes

import candela.geometry.{Bounds3, Frame, Hit, Ray, ShadingPoint}
import candela.math.*

/** A disk or annulus, optionally partial, under any affine transform.
  *
  * @param height      z in object space
  * @param radius      of the rim; if negative, the normals seen are opposite to those of light
  *   sampling, as in pbrt
  * @param innerRadius radius of the hole; 0 for none; of either sign
  * @param phiMax      sweep in radians
  * @param reversed    whether the outside faces −z of object space
  * @param uAlong      what u and v measure
  */
final class Disk(
    objectToWorld: Transform,
    height: Float,
    radius: Float,
    innerRadius: Float,
    phiMax: Float,
    reversed: Boolean,
    uAlong: DiskU = DiskU.Angle
) extends SurfaceOfRevolution(objectToWorld, objectToWorld):
  protected def widest: Double = Math.abs(radius)
  protected def reach: Double = Math.abs(height)

  private val normal =
    val n = objectToWorld.normal(Vec3.Z).normalized
    if reversed then -n else n
  private val dpdx = objectToWorld.vector(Vec3.X)
  private val dpdy = objectToWorld.vector(Vec3.Y)

  val area: Float =
    val stretch = (dpdx cross dpdy).length
    0.5f * phiMax * (square(radius) - square(innerRadius)) * stretch

  def normals: (Vec3, Float) = (normal, 1f)

  def bounds: Bounds3 = worldBounds(Math.abs(radius), height, height)

  def intersect(ray: Ray, hit: Hit): Boolean = shortens(ray, distance(ray))
  def isHit(ray: Ray): Boolean = isWithin(ray, distance(ray))

  /** Distance along the ray to the disk's plane. */
  private def plane(ray: Ray): Double =
    (height - objectZ(ray.ox, ray.oy, ray.oz)) / alongZ(ray)

  private def distance(ray: Ray): Double =
    val t = plane(ray)
    if !(t > 0.0 && t < ray.tMax) then -1.0
    else
      val wx = ray.ox + t * ray.dx
      val wy = ray.oy + t * ray.dy
      val wz = ray.oz + t * ray.dz
      val x = objectX(wx, wy, wz)
      val y = objectY(wx, wy, wz)
      val r2 = x * x + y * y
      val inside = r2 <= radius.toDouble * radius && r2 >= innerRadius.toDouble * innerRadius &&
        (phiMax >= TwoPi || phi(x, y) <= phiMax)
      if inside then t else -1.0

  def surface(ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    val t = refined(plane(ray), ray.tMax)
    val wx = ray.ox + t * ray.dx
    val wy = ray.oy + t * ray.dy
    val wz = ray.oz + t * ray.dz
    val x = objectX(wx, wy, wz)
    val y = objectY(wx, wy, wz)
    // Projected back onto the plane: the point is exact except for the transform's rounding
    setPoint(x, y, height, at)
    val local = Vec3(x.toFloat, y.toFloat, height)
    at.geometricNormal = normal
    if uAlong == DiskU.Radius then alongRadius(local, at) else alongAngle(local, at)

  private def alongRadius(local: Vec3, at: ShadingPoint): Unit =
    val r = sqrt(square(local.x) + square(local.y))
    val outwards = if r > 0f then Vec3(local.x / r, local.y / r, 0f) else Vec3.X
    val dpdu = objectToWorld.vector(outwards * (radius - innerRadius))
    at.u = (r - innerRadius) / (radius - innerRadius)
    at.v = 1f - phi(local.x, local.y).toFloat / phiMax
    at.frame.set(Frame.along(normal, dpdu))
    if at.wantsPartials then
      val dpdv = objectToWorld.vector(Vec3(local.y * phiMax, -local.x * phiMax, 0f))
      at.setPartials(dpdu, dpdv, Vec3.Zero, Vec3.Zero)

  private def alongAngle(local: Vec3, at: ShadingPoint): Unit =
    at.u = phi(local.x, local.y).toFloat / phiMax
    at.v = (radius - sqrt(square(local.x) + square(local.y))) / (radius - innerRadius)
    at.frame.set(Frame.along(normal, objectToWorld.vector(Vec3(-local.y, local.x, 0f))))
    if at.wantsPartials then
      val r = sqrt(square(local.x) + square(local.y))
      val inwards = if r > 0f then (innerRadius - radius) / r else 0f
      at.setPartials(
        objectToWorld.vector(Vec3(-local.y * phiMax, local.x * phiMax, 0f)),
        objectToWorld.vector(Vec3(local.x * inwards, local.y * inwards, 0f)),
        Vec3.Zero,
        Vec3.Zero
      )

  def sampleArea(u1: Float, u2: Float, out: SurfaceSample): Unit =
    val r = sqrt(lerp(u1, square(innerRadius), square(radius)))
    val angle = u2 * phiMax
    out.p = objectToWorld.point(Vec3(r * cos(angle), r * sin(angle), height))
    out.pError = TriangleSoup.roundingError(out.p) + doubleError
    out.n = normal
    out.pdf = 1f / area

  def areaPdf(p: Vec3): Float = 1f / area

/** What the parameters of a disk measure. */
enum DiskU:
  /** u the angle, v the way from the rim (pbrt). */
  case Angle

  /** u the way to the rim, v the angle from its end (Mitsuba). */
  case Radius
