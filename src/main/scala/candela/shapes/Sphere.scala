package candela.shapes

import candela.geometry.{Bounds3, Frame, Hit, Ray, ShadingPoint}
import candela.math.*

/** A sphere, perhaps cut by two planes of constant z and swept over less than a full turn, anywhere
  * in the world and of any affine shape.
  *
  * The quadratic is solved in Double: Float data give a discriminant that is exact enough for
  * spheres a million radii away (stability suite), and the hit point's error is that of its
  * rounding alone.
  *
  * @param zMin, zMax clip planes in object space; −radius, radius for a full sphere
  * @param phiMax     sweep in radians, 2π for a full sphere
  * @param reversed   is the outside the side that p − centre points away from?
  */
final class Sphere(
    objectToWorld: Transform,
    radius: Float,
    zMin: Float,
    zMax: Float,
    phiMax: Float,
    reversed: Boolean
) extends Shape:
  private val toWorld = objectToWorld.m
  private val toObject = objectToWorld.inverseM
  private val full = zMin <= -radius && zMax >= radius && phiMax >= TwoPi
  private val thetaMin = Math.acos(clamp(zMin / radius, -1f, 1f).toDouble)
  private val thetaMax = Math.acos(clamp(zMax / radius, -1f, 1f).toDouble)
  private val center = objectToWorld.point(Vec3.Zero)

  private val uniformScale: Option[Float] = objectToWorld.uniformScale.map(_.toFloat)
  private val worldRadius = radius * uniformScale.getOrElse(1f)
  private val doubleError =
    Quadric.doubleError(objectToWorld, radius.toDouble, radius.toDouble, radius.toDouble)
  private val conical = full && uniformScale.isDefined

  def bounds: Bounds3 = Quadric.worldBounds(objectToWorld, radius, zMin, zMax)

  def intersect(ray: Ray, hit: Hit): Boolean =
    val t = nearest(ray)
    if t > 0.0 && t < ray.tMax then
      ray.tMax = t.toFloat
      true
    else false

  def isHit(ray: Ray): Boolean =
    val t = nearest(ray)
    t > 0.0 && t < ray.tMax

  /** The smallest distance > 0 at which the ray meets the sphere, or −1. */
  private def nearest(ray: Ray): Double =
    val m = toObject
    val ox = m(0) * ray.ox + m(1) * ray.oy + m(2) * ray.oz + m(3)
    val oy = m(4) * ray.ox + m(5) * ray.oy + m(6) * ray.oz + m(7)
    val oz = m(8) * ray.ox + m(9) * ray.oy + m(10) * ray.oz + m(11)
    val dx = m(0) * ray.dx + m(1) * ray.dy + m(2) * ray.dz
    val dy = m(4) * ray.dx + m(5) * ray.dy + m(6) * ray.dz
    val dz = m(8) * ray.dx + m(9) * ray.dy + m(10) * ray.dz
    val a = dx * dx + dy * dy + dz * dz
    val b = ox * dx + oy * dy + oz * dz
    val r2 = radius.toDouble * radius
    val c = ox * ox + oy * oy + oz * oz - r2
    // r² − |o − (b/a) d|² does not cancel far from a small sphere, as b² − ac does (Haines et al.,
    // "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019)
    val s = b / a
    val nx = ox - s * dx
    val ny = oy - s * dy
    val nz = oz - s * dz
    val discriminant = a * (r2 - (nx * nx + ny * ny + nz * nz))
    if !(discriminant >= 0.0) then -1.0
    else
      val root = Math.sqrt(discriminant)
      val q = -(b + (if b < 0.0 then -root else root))
      val t0 = if b < 0.0 then c / q else q / a
      val t1 = if b < 0.0 then q / a else c / q
      if t0 > 0.0 && isKept(ox + t0 * dx, oy + t0 * dy, oz + t0 * dz) then t0
      else if t1 > 0.0 && isKept(ox + t1 * dx, oy + t1 * dy, oz + t1 * dz) then t1
      else -1.0

  private def isKept(x: Double, y: Double, z: Double): Boolean =
    full || (z >= zMin && z <= zMax && Sphere.phi(x, y) <= phiMax)

  def surface(ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    // Once more in Double: from a million radii away the Float t is a twentieth of one off
    val m = toObject
    val t = Quadric.refined(nearest(ray), ray.tMax)
    val wx = ray.ox + t * ray.dx
    val wy = ray.oy + t * ray.dy
    val wz = ray.oz + t * ray.dz
    val px = m(0) * wx + m(1) * wy + m(2) * wz + m(3)
    val py = m(4) * wx + m(5) * wy + m(6) * wz + m(7)
    val pz = m(8) * wx + m(9) * wy + m(10) * wz + m(11)
    val scale = radius / Math.sqrt(px * px + py * py + pz * pz)
    val x = px * scale
    val y = py * scale
    val z = pz * scale
    at.p = Quadric.place(toWorld, x, y, z)
    at.pError = TriangleSoup.roundingError(at.p) + doubleError
    val outward = objectToWorld.normal(Vec3(x.toFloat, y.toFloat, z.toFloat)).normalized
    at.geometricNormal = if reversed then -outward else outward
    val phi = Sphere.phi(x, y)
    at.u = (phi / phiMax).toFloat
    at.v = ((Math.acos(Math.max(-1.0, Math.min(1.0, z / radius))) - thetaMin) /
      (thetaMax - thetaMin)).toFloat
    val dpdu = objectToWorld.vector(Vec3(-y.toFloat, x.toFloat, 0f))
    at.frame.set(Frame.along(at.geometricNormal, dpdu))
    if at.wantsPartials then partials(x, y, z, at)

  private def partials(x: Double, y: Double, z: Double, at: ShadingPoint): Unit =
    val perU = phiMax.toDouble
    val perV = thetaMax - thetaMin
    val r = Math.sqrt(x * x + y * y)
    // At a pole any direction is as good
    val c = if r > 0 then x / r else 1.0
    val s = if r > 0 then y / r else 0.0
    val alongU = Vec3((-y * perU).toFloat, (x * perU).toFloat, 0f)
    val alongV = Vec3((z * c * perV).toFloat, (z * s * perV).toFloat, (-r * perV).toFloat)
    // The normal of an untransformed sphere is the point itself, over the radius
    val side = if reversed then -1f / radius else 1f / radius
    val n = objectToWorld.normal(Vec3(x.toFloat, y.toFloat, z.toFloat) * side)
    at.setPartials(
      objectToWorld.vector(alongU),
      objectToWorld.vector(alongV),
      ShadingPoint.turn(n, objectToWorld.normal(alongU * side)),
      ShadingPoint.turn(n, objectToWorld.normal(alongV * side))
    )

  def normals: (Vec3, Float) = (Vec3.Z, -1f)

  def area: Float = uniformScale match
    case Some(scale) => phiMax * radius * (zMax - zMin) * square(scale)
    case None =>
      RevolutionSampling(objectToWorld, Profile.sphere(radius, zMin, zMax), phiMax).area.toFloat

  override def sample(from: Vec3, u1: Float, u2: Float, out: SurfaceSample): Unit =
    if conical && (from - center).lengthSquared > square(worldRadius) * 1.0001f then
      SphereSampling.cone(center, worldRadius, from, u1, u2, out)
      if reversed then out.n = -out.n
    else super.sample(from, u1, u2, out)

  /** Uniform in z and φ, hence uniform by area on the untransformed sphere; `out.pdf` per world
    * area.
    */
  def sampleArea(u1: Float, u2: Float, out: SurfaceSample): Unit =
    // In Double up to the world point, for whose rounding alone `pError` stands (SpawnedRaySuite)
    val z = zMin + u1.toDouble * (zMax.toDouble - zMin)
    val r = Math.sqrt(Math.max(0.0, radius.toDouble * radius - z * z))
    val phi = u2.toDouble * phiMax
    val x = r * Math.cos(phi)
    val y = r * Math.sin(phi)
    out.p = Quadric.place(toWorld, x, y, z)
    out.pError = TriangleSoup.roundingError(out.p) + doubleError
    val n = objectToWorld.normal(Vec3(x.toFloat, y.toFloat, z.toFloat))
    // dA(world) = |det M| · |M⁻ᵀ n| dA(object) for the unit normal n
    val stretch = Math.abs(objectToWorld.determinant).toFloat * n.length / radius
    out.n = if reversed then -n.normalized else n.normalized
    out.pdf = 1f / (phiMax * radius * (zMax - zMin) * stretch)

  override def pdf(from: Vec3, p: Vec3, n: Vec3): Float =
    if conical && (from - center).lengthSquared > square(worldRadius) * 1.0001f then
      SphereSampling.conePdf(center, worldRadius, from)
    else super.pdf(from, p, n)

  def areaPdf(p: Vec3): Float =
    val q = objectToWorld.inverse.point(p)
    val stretch =
      Math.abs(objectToWorld.determinant).toFloat * objectToWorld.normal(q).length / radius
    1f / (phiMax * radius * (zMax - zMin) * stretch)

object Sphere:
  private def phi(x: Double, y: Double): Double =
    val a = Math.atan2(y, x)
    if a < 0 then a + 2 * Math.PI else a
