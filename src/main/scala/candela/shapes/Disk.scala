package candela.shapes

import candela.geometry.{Bounds3, Frame, Hit, Ray, ShadingPoint}
import candela.math.*

/** A flat disk or annulus, perhaps swept over less than a full turn, in any affine position.
  *
  * @param height      its z in object space
  * @param innerRadius of the hole, 0: none
  * @param phiMax      sweep in radians
  * @param reversed    is the outside the side of object space's −z?
  */
final class Disk(
    objectToWorld: Transform,
    height: Float,
    radius: Float,
    innerRadius: Float,
    phiMax: Float,
    reversed: Boolean
) extends Shape:
  private val toWorld = objectToWorld.m
  private val toObject = objectToWorld.inverseM
  private val doubleError =
    Quadric.doubleError(objectToWorld, radius.toDouble, radius.toDouble, Math.abs(height.toDouble))
  private val normal =
    val n = objectToWorld.normal(Vec3.Z).normalized
    if reversed then -n else n
  private val dpdx = objectToWorld.vector(Vec3.X)
  private val dpdy = objectToWorld.vector(Vec3.Y)

  val area: Float =
    val stretch = (dpdx cross dpdy).length
    0.5f * phiMax * (square(radius) - square(innerRadius)) * stretch

  def normals: (Vec3, Float) = (normal, 1f)

  def bounds: Bounds3 = Quadric.worldBounds(objectToWorld, radius, height, height)

  def intersect(ray: Ray, hit: Hit): Boolean =
    val t = distance(ray)
    if t > 0.0 && t < ray.tMax then
      ray.tMax = t.toFloat
      true
    else false

  def isHit(ray: Ray): Boolean =
    val t = distance(ray)
    t > 0.0 && t < ray.tMax

  /** How far it is along the ray to the disk's plane. */
  private def plane(ray: Ray): Double =
    val m = toObject
    val oz = m(8) * ray.ox + m(9) * ray.oy + m(10) * ray.oz + m(11)
    val dz = m(8) * ray.dx + m(9) * ray.dy + m(10) * ray.dz
    (height - oz) / dz

  private def distance(ray: Ray): Double =
    val m = toObject
    val t = plane(ray)
    if !(t > 0.0 && t < ray.tMax) then -1.0
    else
      val x = m(0) * (ray.ox + t * ray.dx) + m(1) * (ray.oy + t * ray.dy) +
        m(2) * (ray.oz + t * ray.dz) + m(3)
      val y = m(4) * (ray.ox + t * ray.dx) + m(5) * (ray.oy + t * ray.dy) +
        m(6) * (ray.oz + t * ray.dz) + m(7)
      val r2 = x * x + y * y
      val inside = r2 <= radius.toDouble * radius && r2 >= innerRadius.toDouble * innerRadius &&
        (phiMax >= TwoPi || angle(x, y) <= phiMax)
      if inside then t else -1.0

  private def angle(x: Double, y: Double): Double =
    val a = Math.atan2(y, x)
    if a < 0 then a + 2 * Math.PI else a

  def surface(ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    val m = toObject
    val t = Quadric.refined(plane(ray), ray.tMax)
    val wx = ray.ox + t * ray.dx
    val wy = ray.oy + t * ray.dy
    val wz = ray.oz + t * ray.dz
    val x = m(0) * wx + m(1) * wy + m(2) * wz + m(3)
    val y = m(4) * wx + m(5) * wy + m(6) * wz + m(7)
    // Put back into the plane: the point is exact but for the rounding of the way to world space
    at.p = Quadric.place(toWorld, x, y, height.toDouble)
    at.pError = TriangleSoup.roundingError(at.p) + doubleError
    val local = Vec3(x.toFloat, y.toFloat, height)
    at.geometricNormal = normal
    val phi = angle(local.x.toDouble, local.y.toDouble).toFloat
    at.u = phi / phiMax
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
    val phi = u2 * phiMax
    out.p = objectToWorld.point(Vec3(r * cos(phi), r * sin(phi), height))
    out.pError = TriangleSoup.roundingError(out.p) + doubleError
    out.n = normal
    out.pdf = 1f / area

  def areaPdf(p: Vec3): Float = 1f / area
