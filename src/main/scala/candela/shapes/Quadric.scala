package candela.shapes

import candela.geometry.{Bounds3, Frame, Hit, Ray, ShadingPoint}
import candela.math.*

/** A cylinder, cone, paraboloid or hyperboloid, perhaps swept over less than a full turn, anywhere
  * in the world and of any affine shape. Open at its ends.
  *
  * The quadratic is solved in Double, after the ray's origin is moved to where the ray is nearest
  * to the shape's middle: so its coefficients don't cancel when the ray comes from far away.
  *
  * @param phiMax   sweep in radians, 2π for a full turn
  * @param reversed is the outside the side that the gradient points away from?
  */
final class Quadric(
    objectToWorld: Transform,
    profile: Profile,
    phiMax: Float,
    reversed: Boolean
) extends Shape:
  private val toWorld = objectToWorld.m
  private val toObject = objectToWorld.inverseM
  private val g0 = profile.g0
  private val g1 = profile.g1
  private val g2 = profile.g2
  private val zMin = profile.zMin
  private val zMax = profile.zMax
  private val zMiddle = 0.5 * (zMin + zMax)
  private val full = phiMax >= TwoPi
  private val outside = if reversed != profile.vSpan < 0 then -1f else 1f
  private lazy val sampling = RevolutionSampling(objectToWorld, profile, phiMax)
  private val reach = Math.max(Math.abs(zMin), Math.abs(zMax))
  private val doubleError =
    Quadric.doubleError(objectToWorld, profile.radius, profile.radius, reach)

  def bounds: Bounds3 = Quadric.worldBounds(
    objectToWorld,
    Math.nextUp(profile.radius.toFloat),
    Math.nextDown(zMin.toFloat),
    Math.nextUp(zMax.toFloat)
  )

  def intersect(ray: Ray, hit: Hit): Boolean =
    val t = nearest(ray)
    if t > 0.0 && t < ray.tMax then
      ray.tMax = t.toFloat
      true
    else false

  def isHit(ray: Ray): Boolean =
    val t = nearest(ray)
    t > 0.0 && t < ray.tMax

  /** The smallest distance > 0 at which the ray meets the surface, or −1. */
  private def nearest(ray: Ray): Double =
    val m = toObject
    val dx = m(0) * ray.dx + m(1) * ray.dy + m(2) * ray.dz
    val dy = m(4) * ray.dx + m(5) * ray.dy + m(6) * ray.dz
    val dz = m(8) * ray.dx + m(9) * ray.dy + m(10) * ray.dz
    val ex = m(0) * ray.ox + m(1) * ray.oy + m(2) * ray.oz + m(3)
    val ey = m(4) * ray.ox + m(5) * ray.oy + m(6) * ray.oz + m(7)
    val ez = m(8) * ray.ox + m(9) * ray.oy + m(10) * ray.oz + m(11)
    val shift = -(ex * dx + ey * dy + (ez - zMiddle) * dz) / (dx * dx + dy * dy + dz * dz)
    val ox = ex + shift * dx
    val oy = ey + shift * dy
    val oz = ez + shift * dz
    val a = dx * dx + dy * dy - g2 * dz * dz
    val b = ox * dx + oy * dy - (0.5 * g1 + g2 * oz) * dz
    val c = ox * ox + oy * oy - (g0 + oz * (g1 + g2 * oz))
    val discriminant = b * b - a * c
    if !(discriminant >= 0.0) then -1.0
    else
      val root = Math.sqrt(discriminant)
      val q = if b < 0.0 then root - b else -(b + root)
      // Along an axis or a generator a is 0 and one root is infinite or NaN: no comparison below
      // takes it for a hit
      val s0 = q / a
      val s1 = c / q
      val near = if s1 < s0 then s1 else s0
      val far = if s1 < s0 then s0 else s1
      if shift + near > 0.0 && isKept(ox + near * dx, oy + near * dy, oz + near * dz) then
        shift + near
      else if shift + far > 0.0 && isKept(ox + far * dx, oy + far * dy, oz + far * dz) then
        shift + far
      else -1.0

  private def isKept(x: Double, y: Double, z: Double): Boolean =
    z >= zMin && z <= zMax && (full || profile.angle(x, y, z) <= phiMax)

  def surface(ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    val m = toObject
    val t = Quadric.refined(nearest(ray), ray.tMax)
    val wx = ray.ox + t * ray.dx
    val wy = ray.oy + t * ray.dy
    val wz = ray.oz + t * ray.dz
    var x = m(0) * wx + m(1) * wy + m(2) * wz + m(3)
    var y = m(4) * wx + m(5) * wy + m(6) * wz + m(7)
    var z = m(8) * wx + m(9) * wy + m(10) * wz + m(11)
    // Behind a hole the t is a Float, a millionth off; two of Newton's steps along the gradient
    // bring the point onto the surface
    var steps = 2
    while steps > 0 do
      val s = profile.slope(z)
      val gradient2 = x * x + y * y + s * s
      val k = 0.5 * (x * x + y * y - profile.radius2(z)) / gradient2
      if Math.abs(k) < 0.5 then // not at a cone's tip
        x -= k * x
        y -= k * y
        z += k * s
      steps -= 1
    at.p = Quadric.place(toWorld, x, y, z)
    at.pError = TriangleSoup.roundingError(at.p) + doubleError
    val slope = profile.slope(z)
    val gradient = Vec3(x.toFloat, y.toFloat, -slope.toFloat)
    // A tip points up, as far as it has a direction at all
    val up = if gradient.isZero then Vec3.Z else gradient
    at.geometricNormal = objectToWorld.normal(up).normalized * outside
    at.u = Math.min(1.0, profile.angle(x, y, z) / phiMax).toFloat
    at.v = Math.max(0.0, Math.min(1.0, profile.v(z))).toFloat
    at.frame.set(Frame.along(
      at.geometricNormal,
      objectToWorld.vector(Vec3(-y.toFloat, x.toFloat, 0))
    ))
    if at.wantsPartials then partials(x, y, z, at)

  /** A step in v goes along the outline, and turns with the seam. */
  private def partials(x: Double, y: Double, z: Double, at: ShadingPoint): Unit =
    val slope = profile.slope(z)
    val radius2 = x * x + y * y
    // At a tip any direction is as good
    val widening = if radius2 > 0 then profile.vSpan * slope / radius2 else 0.0
    val turn = profile.seamPerV(z)
    val alongU = Vec3((-y * phiMax).toFloat, (x * phiMax).toFloat, 0f)
    val vx = x * widening - y * turn
    val vy = y * widening + x * turn
    val alongV = Vec3(vx.toFloat, vy.toFloat, profile.vSpan.toFloat)
    val bend = Vec3(vx.toFloat, vy.toFloat, (-g2 * profile.vSpan).toFloat)
    val n = objectToWorld.normal(Vec3(x.toFloat, y.toFloat, -slope.toFloat)) * outside
    def turned(along: Vec3) =
      if n.isZero then Vec3.Zero else ShadingPoint.turn(n, objectToWorld.normal(along) * outside)
    val dpdu = objectToWorld.vector(alongU)
    val dpdv = objectToWorld.vector(alongV)
    at.setPartials(dpdu, dpdv, turned(alongU), turned(bend))

  def normals: (Vec3, Float) = (Vec3.Z, -1f)

  def area: Float = sampling.area.toFloat

  def sampleArea(u1: Float, u2: Float, out: SurfaceSample): Unit =
    sampling.sample(u1, u2, out)
    out.pError = out.pError + doubleError
    out.n = out.n * outside

  def areaPdf(p: Vec3): Float = sampling.perArea(p)

object Quadric:
  /** The largest error, per component, that Double arithmetic makes of a point in a box of this
    * half extent around the origin of object space, on its way to the world and back: some 2⁶
    * round-offs of the largest number on the way. It counts where such a point is close to the
    * world's origin, as on a ground that is a sphere of radius 1e6.
    */
  private[shapes] def doubleError(toWorld: Transform, x: Double, y: Double, z: Double): Vec3 =
    val m = toWorld.m
    def row(r: Int) = (1.4e-14 * (Math.abs(m(r)) * x + Math.abs(m(r + 1)) * y +
      Math.abs(m(r + 2)) * z + Math.abs(m(r + 3)))).toFloat
    Vec3(row(0), row(4), row(8))

  /** The distance of a hit that shortened a ray to `t`, as found again in Double; `t` itself if
    * what was found is another one, as behind a hole.
    */
  private[shapes] def refined(found: Double, t: Float): Double =
    if Math.abs(found - t) <= 1e-6 * t then found else t.toDouble

  /** The box around the placed cylinder |x|, |y| ≤ radius, zMin ≤ z ≤ zMax. */
  private[shapes] def worldBounds(
      objectToWorld: Transform,
      radius: Float,
      zMin: Float,
      zMax: Float
  ): Bounds3 =
    val box = Bounds3(Vec3(-radius, -radius, zMin), Vec3(radius, radius, zMax))
    val world = Bounds3.of((0 until 8).map(i => objectToWorld.point(box.corner(i))))
    def reach(axis: Int) = Math.max(Math.abs(world.min(axis)), Math.abs(world.max(axis)))
    val pad = TriangleSoup.roundingError(Vec3(reach(0), reach(1), reach(2)))
    Bounds3(world.min - pad, world.max + pad)

  private[shapes] def place(m: IArray[Double], x: Double, y: Double, z: Double): Vec3 =
    Vec3(
      (m(0) * x + m(1) * y + m(2) * z + m(3)).toFloat,
      (m(4) * x + m(5) * y + m(6) * z + m(7)).toFloat,
      (m(8) * x + m(9) * y + m(10) * z + m(11)).toFloat
    )
