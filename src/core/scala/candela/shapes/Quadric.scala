package candela.shapes

import candela.geometry.{Bounds3, Frame, Hit, Ray, ShadingPoint}
import candela.math.*

/** A cylinder, cone, paraboloid or hyperboloid, optionally partial, under any affine transform.
  * Open at its ends.
  *
  * Solves the quadratic in Double, with the ray's origin moved to the point closest to the shape's
  * centre: its coefficients then do not cancel for distant ray origins.
  *
  * @param phiMax   sweep in radians, 2π for a full revolution
  * @param reversed whether the outside faces against the gradient
  */
final class Quadric(
    objectToWorld: Transform,
    profile: Profile,
    phiMax: Float,
    reversed: Boolean
) extends SurfaceOfRevolution(objectToWorld, objectToWorld):
  protected def widest: Double = profile.radius
  protected def reach: Double = Math.max(Math.abs(profile.zMin), Math.abs(profile.zMax))

  private val g0 = profile.g0
  private val g1 = profile.g1
  private val g2 = profile.g2
  private val zMin = profile.zMin
  private val zMax = profile.zMax
  private val zMiddle = 0.5 * (zMin + zMax)
  private val full = phiMax >= TwoPi
  private val outside = if reversed != profile.vSpan < 0 then -1f else 1f
  private lazy val sampling = RevolutionSampling(objectToWorld, profile, phiMax)

  def bounds: Bounds3 = worldBounds(
    Math.nextUp(profile.radius.toFloat),
    Math.nextDown(zMin.toFloat),
    Math.nextUp(zMax.toFloat)
  )

  def intersect(ray: Ray, hit: Hit): Boolean = shortens(ray, nearest(ray))
  def isHit(ray: Ray): Boolean = isWithin(ray, nearest(ray))

  /** Distance > 0 of the closest hit, or −1. */
  private def nearest(ray: Ray): Double =
    val dx = alongX(ray)
    val dy = alongY(ray)
    val dz = alongZ(ray)
    val ex = objectX(ray.ox, ray.oy, ray.oz)
    val ey = objectY(ray.ox, ray.oy, ray.oz)
    val ez = objectZ(ray.ox, ray.oy, ray.oz)
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
      // For a ray along an axis or a generator a is 0, and one root is infinite or NaN: all
      // comparisons below reject it
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
    val t = refined(nearest(ray), ray.tMax)
    val wx = ray.ox + t * ray.dx
    val wy = ray.oy + t * ray.dy
    val wz = ray.oz + t * ray.dz
    var x = objectX(wx, wy, wz)
    var y = objectY(wx, wy, wz)
    var z = objectZ(wx, wy, wz)
    // Behind an alpha cutout t is a Float, a millionth off; two Newton steps along the gradient
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
    setPoint(x, y, z, at)
    val slope = profile.leaning(x, y, z)
    val gradient = Vec3(x.toFloat, y.toFloat, -slope.toFloat)
    // An apex points up, as the gradient is zero there
    val objectNormal = if gradient.isZero then Vec3.Z else gradient
    at.geometricNormal = objectToWorld.normal(objectNormal).normalized * outside
    at.u = Math.min(1.0, profile.angle(x, y, z) / phiMax).toFloat
    at.v = Math.max(0.0, Math.min(1.0, profile.v(z))).toFloat
    at.frame.set(Frame.along(
      at.geometricNormal,
      objectToWorld.vector(Vec3(-y.toFloat, x.toFloat, 0))
    ))
    if at.wantsPartials then partials(x, y, z, at)

  private def partials(x: Double, y: Double, z: Double, at: ShadingPoint): Unit =
    if profile.loose then loosePartials(x, y, z, at) else followingPartials(x, y, z, at)

  /** ∂p/∂v is that of the line; ∂n/∂u and ∂n/∂v follow from it by the equations of Weingarten, as
    * in pbrt.
    */
  private def loosePartials(x: Double, y: Double, z: Double, at: ShadingPoint): Unit =
    val alongU = Vec3((-y * phiMax).toFloat, (x * phiMax).toFloat, 0f)
    val alongV = profile.alongLine(x, y, z)
    val n = (alongU cross alongV).normalized
    val e = n dot Vec3(-x.toFloat, -y.toFloat, 0f) * square(phiMax)
    val f = n dot Vec3(-alongV.y, alongV.x, 0f) * phiMax
    val (uu, uv, vv) = (alongU dot alongU, alongU dot alongV, alongV dot alongV)
    val inverse = 1f / (uu * vv - uv * uv)
    val bendU = (alongU * (f * uv - e * vv) + alongV * (e * uv - f * uu)) * inverse
    val bendV = (alongU * (-f * vv) + alongV * (f * uv)) * inverse
    setDerivatives(alongU, alongV, n, bendU, bendV, at)

  /** Sets the derivatives from object space.
    *
    * @param n            unit normal on the side of ∂p/∂u × ∂p/∂v
    * @param bendU, bendV its derivatives
    */
  private def setDerivatives(
      alongU: Vec3,
      alongV: Vec3,
      n: Vec3,
      bendU: Vec3,
      bendV: Vec3,
      at: ShadingPoint
  ): Unit =
    val across = objectToWorld.normal(n)
    val side = if reversed then -1f else 1f
    val byU = objectToWorld.normal(bendU)
    val byV = objectToWorld.normal(bendV)
    at.setPartials(
      objectToWorld.vector(alongU),
      objectToWorld.vector(alongV),
      ShadingPoint.turn(across, byU) * side,
      ShadingPoint.turn(across, byV) * side
    )
    at.bendU = byU
    at.bendV = byV

  /** ∂p/∂v follows the profile, and rotates with the seam. */
  private def followingPartials(x: Double, y: Double, z: Double, at: ShadingPoint): Unit =
    val slope = profile.slope(z)
    val radius2 = x * x + y * y
    // Any direction serves at an apex
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
    // pbrt's are of the unit normal in object space, on the side of ∂p/∂u × ∂p/∂v
    val objectNormal = Vec3(x.toFloat, y.toFloat, -slope.toFloat)
    if !objectNormal.isZero then
      val upwards = if profile.vSpan < 0 then -1f else 1f
      at.bendU = objectToWorld.normal(ShadingPoint.turn(objectNormal, alongU)) * upwards
      at.bendV = objectToWorld.normal(ShadingPoint.turn(objectNormal, bend)) * upwards

  def normals: (Vec3, Float) = (Vec3.Z, -1f)

  def area: Float = sampling.area.toFloat

  def sampleArea(u1: Float, u2: Float, out: SurfaceSample): Unit =
    sampling.sample(u1, u2, out)
    out.pError = out.pError + doubleError
    out.n = out.n * outside

  def areaPdf(p: Vec3): Float = sampling.perArea(p)
