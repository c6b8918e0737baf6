package candela.shapes

import candela.geometry.{Bounds3, Frame, Hit, Ray, ShadingPoint}
import candela.math.*

/** A sphere, optionally clipped by two planes of constant z and partial in φ, under any affine
  * transform.
  *
  * Solves the quadratic in Double: with Float data its discriminant is exact enough for spheres a
  * million radii away (stability suite), and the hit point's error is that of its rounding alone.
  *
  * @param form          what it shares with others
  * @param objectToWorld differs from that of its form in its translation alone
  */
final class Sphere private[shapes] (
    private[candela] val form: SphereForm,
    objectToWorld: Transform
) extends SurfaceOfRevolution(objectToWorld, form.map):
  import form.*

  protected def widest: Double = radius
  protected def reach: Double = radius

  private def center: Vec3 = worldPoint(Vec3.Zero)

  def bounds: Bounds3 = worldBounds(radius, zMin, zMax)

  def intersect(ray: Ray, hit: Hit): Boolean = shortens(ray, nearest(ray))
  def isHit(ray: Ray): Boolean = isWithin(ray, nearest(ray))

  /** Distance > 0 of the closest hit, or −1. */
  private def nearest(ray: Ray): Double =
    val ox = objectX(ray.ox, ray.oy, ray.oz)
    val oy = objectY(ray.ox, ray.oy, ray.oz)
    val oz = objectZ(ray.ox, ray.oy, ray.oz)
    val dx = alongX(ray)
    val dy = alongY(ray)
    val dz = alongZ(ray)
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
    full || (z >= zMin && z <= zMax && phi(x, y) <= phiMax)

  def surface(ray: Ray, hit: Hit, at: ShadingPoint): Unit =
    // In Double: at a distance of a million radii the Float t is off by a twentieth of a radius
    val t = refined(nearest(ray), ray.tMax)
    val wx = ray.ox + t * ray.dx
    val wy = ray.oy + t * ray.dy
    val wz = ray.oz + t * ray.dz
    val px = objectX(wx, wy, wz)
    val py = objectY(wx, wy, wz)
    val pz = objectZ(wx, wy, wz)
    val scale = radius / Math.sqrt(px * px + py * py + pz * pz)
    val x = px * scale
    val y = py * scale
    val z = pz * scale
    setPoint(x, y, z, at)
    val outward = map.normal(Vec3(x.toFloat, y.toFloat, z.toFloat)).normalized
    at.geometricNormal = if reversed then -outward else outward
    at.u = (phi(x, y) / phiMax).toFloat
    at.v = ((Math.acos(Math.max(-1.0, Math.min(1.0, z / radius))) - thetaMin) /
      (thetaMax - thetaMin)).toFloat
    val dpdu = map.vector(Vec3(-y.toFloat, x.toFloat, 0f))
    at.frame.set(Frame.along(at.geometricNormal, dpdu))
    if at.wantsPartials then partials(x, y, z, at)

  private def partials(x: Double, y: Double, z: Double, at: ShadingPoint): Unit =
    val perU = phiMax.toDouble
    val perV = thetaMax - thetaMin
    val r = Math.sqrt(x * x + y * y)
    // Any direction serves at a pole
    val c = if r > 0 then x / r else 1.0
    val s = if r > 0 then y / r else 0.0
    val alongU = Vec3((-y * perU).toFloat, (x * perU).toFloat, 0f)
    val alongV = Vec3((z * c * perV).toFloat, (z * s * perV).toFloat, (-r * perV).toFloat)
    // The normal of an untransformed sphere is the point itself, over the radius
    val side = if reversed then -1f / radius else 1f / radius
    val n = map.normal(Vec3(x.toFloat, y.toFloat, z.toFloat) * side)
    val alongNU = map.normal(alongU * side)
    val alongNV = map.normal(alongV * side)
    at.setPartials(
      map.vector(alongU),
      map.vector(alongV),
      ShadingPoint.turn(n, alongNU),
      ShadingPoint.turn(n, alongNV)
    )
    val outwards = if reversed then -1f else 1f
    at.bendU = alongNU * outwards
    at.bendV = alongNV * outwards

  def normals: (Vec3, Float) = (Vec3.Z, -1f)

  /** By quadrature of thousands of points: once, since each sample of a caustic asks for it. */
  private lazy val stretchedArea: Float =
    RevolutionSampling(map, Profile.sphere(radius, zMin, zMax), phiMax).area.toFloat

  def area: Float = uniformScale match
    case Some(scale) => phiMax * radius * (zMax - zMin) * square(scale)
    case None => stretchedArea

  override def sample(from: Vec3, u1: Float, u2: Float, out: SurfaceSample): Unit =
    if conical && (from - center).lengthSquared > square(worldRadius) * 1.0001f then
      SphereSampling.cone(center, worldRadius, from, u1, u2, out)
      if reversed then out.n = -out.n
    else super.sample(from, u1, u2, out)

  /** Uniform in z and φ, hence uniform by area on the untransformed sphere; `out.pdf` is per world
    * area.
    */
  def sampleArea(u1: Float, u2: Float, out: SurfaceSample): Unit =
    // In Double up to the world point: `pError` covers its rounding only (SpawnedRaySuite)
    val z = zMin + u1.toDouble * (zMax.toDouble - zMin)
    val r = Math.sqrt(Math.max(0.0, radius.toDouble * radius - z * z))
    val angle = u2.toDouble * phiMax
    val x = r * Math.cos(angle)
    val y = r * Math.sin(angle)
    setPoint(x, y, z, out)
    val n = map.normal(Vec3(x.toFloat, y.toFloat, z.toFloat))
    // dA(world) = |det M| · |M⁻ᵀ n| dA(object) for the unit normal n
    val stretch = Math.abs(map.determinant).toFloat * n.length / radius
    out.n = if reversed then -n.normalized else n.normalized
    out.pdf = 1f / (phiMax * radius * (zMax - zMin) * stretch)

  override def pdf(from: Vec3, p: Vec3, n: Vec3): Float =
    if conical && (from - center).lengthSquared > square(worldRadius) * 1.0001f then
      SphereSampling.conePdf(center, worldRadius, from)
    else super.pdf(from, p, n)

  def areaPdf(p: Vec3): Float =
    val q = objectPoint(p)
    val stretch =
      Math.abs(map.determinant).toFloat * map.normal(q).length / radius
    1f / (phiMax * radius * (zMax - zMin) * stretch)

object Sphere:
  /** @param zMin, zMax clipping planes in object space; −radius, radius for a full sphere
    * @param phiMax     sweep in radians, 2π for a full sphere
    * @param reversed   whether the outside faces the centre
    */
  def apply(
      objectToWorld: Transform,
      radius: Float,
      zMin: Float,
      zMax: Float,
      phiMax: Float,
      reversed: Boolean
  ): Sphere =
    new Sphere(SphereForm(objectToWorld, radius, zMin, zMax, phiMax, reversed), objectToWorld)
