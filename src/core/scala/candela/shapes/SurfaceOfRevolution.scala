package candela.shapes

import candela.base.loop
import candela.geometry.{Bounds3, Ray, ShadingPoint}
import candela.math.*

/** A surface of revolution about the z-axis of object space, optionally partial, under any affine
  * transform. Common base: transforms rays to object space in Double, and points to world space.
  *
  * @param like a transform that differs from `objectToWorld` in its translation alone, if at all:
  *             its numbers are shared
  */
abstract class SurfaceOfRevolution(objectToWorld: Transform, like: Transform) extends Shape:
  // Without their translations, which follow
  private val toWorld = like.m
  private val toObject = like.inverseM
  private val worldX = objectToWorld.m(3)
  private val worldY = objectToWorld.m(7)
  private val worldZ = objectToWorld.m(11)
  private val backX = objectToWorld.inverseM(3)
  private val backY = objectToWorld.inverseM(7)
  private val backZ = objectToWorld.inverseM(11)

  /** Upper bounds of its radius and of |z|, in object space. */
  protected def widest: Double
  protected def reach: Double

  /** Largest error, per component, of a point in a box of this half extent around the origin of
    * object space, caused by Double arithmetic on the way to world space and back: some 2⁶ rounding
    * errors of the largest number involved. It matters for points close to the world's origin, as
    * on a ground that is a sphere of radius 1e6.
    */
  protected final def doubleError: Vec3 =
    Vec3(doubleError(0, worldX), doubleError(4, worldY), doubleError(8, worldZ))

  private def doubleError(r: Int, shift: Double): Float =
    (1.4e-14 * (Math.abs(toWorld(r)) * widest + Math.abs(toWorld(r + 1)) * widest +
      Math.abs(toWorld(r + 2)) * reach + Math.abs(shift))).toFloat

  // A world-space point in object space

  protected final def objectX(x: Double, y: Double, z: Double): Double = point(0, backX, x, y, z)
  protected final def objectY(x: Double, y: Double, z: Double): Double = point(4, backY, x, y, z)
  protected final def objectZ(x: Double, y: Double, z: Double): Double = point(8, backZ, x, y, z)

  private def point(row: Int, shift: Double, x: Double, y: Double, z: Double): Double =
    val m = toObject
    m(row) * x + m(row + 1) * y + m(row + 2) * z + shift

  /** A point of object space in world space, by maps with a perspective, too. */
  protected final def worldPoint(p: Vec3): Vec3 =
    SurfaceOfRevolution.mapped(toWorld, worldX, worldY, worldZ, p)

  /** A point of world space in object space. */
  protected final def objectPoint(p: Vec3): Vec3 =
    SurfaceOfRevolution.mapped(toObject, backX, backY, backZ, p)

  // The ray's direction in object space

  protected final def alongX(ray: Ray): Double = direction(0, ray)
  protected final def alongY(ray: Ray): Double = direction(4, ray)
  protected final def alongZ(ray: Ray): Double = direction(8, ray)

  private def direction(row: Int, ray: Ray): Double =
    val m = toObject
    m(row) * ray.dx + m(row + 1) * ray.dy + m(row + 2) * ray.dz

  /** Shortens the ray if `t` is a hit; returns whether it is. */
  protected final def shortens(ray: Ray, t: Double): Boolean =
    val isOne = isWithin(ray, t)
    if isOne then ray.tMax = t.toFloat
    isOne

  /** Compared as it is stored: of two at one distance, neither is closer. */
  protected final def isWithin(ray: Ray, t: Double): Boolean = t > 0.0 && t.toFloat < ray.tMax

  /** Distance of the hit that shortened a ray to `t`, recomputed in Double; `t` itself if `exact`
    * is another hit, as behind an alpha cutout.
    */
  protected final def refined(exact: Double, t: Float): Double =
    if Math.abs(exact - t) <= 1e-6 * t then exact else t.toDouble

  /** Sets the point from object space, with its error bound in world space. */
  protected final def setPoint(x: Double, y: Double, z: Double, at: ShadingPoint): Unit =
    at.p = placed(x, y, z)
    at.pError = TriangleSoup.roundingError(at.p) + doubleError

  private def placed(x: Double, y: Double, z: Double): Vec3 =
    SurfaceOfRevolution.mapPoint(toWorld, worldX, worldY, worldZ, x, y, z)

  protected final def setPoint(x: Double, y: Double, z: Double, out: SurfaceSample): Unit =
    out.p = placed(x, y, z)
    out.pError = TriangleSoup.roundingError(out.p) + doubleError

  /** Angle around the z-axis, from 0 to 2π. */
  protected final def phi(x: Double, y: Double): Double =
    val a = Math.atan2(y, x)
    if a < 0 then a + 2 * Math.PI else a

  /** World bounds of the cylinder |x|, |y| ≤ radius, zMin ≤ z ≤ zMax. */
  protected final def worldBounds(radius: Float, zMin: Float, zMax: Float): Bounds3 =
    // As `Bounds3.mapped` of the corners, without objects: there may be millions
    val m = toWorld
    var lowX, lowY, lowZ = Float.PositiveInfinity
    var highX, highY, highZ = Float.NegativeInfinity
    loop(8): i =>
      val x = (if (i & 1) == 0 then -radius else radius).toDouble
      val y = (if (i & 2) == 0 then -radius else radius).toDouble
      val z = (if (i & 4) == 0 then zMin else zMax).toDouble
      val w = m(12) * x + m(13) * y + m(14) * z + m(15)
      val px = ((m(0) * x + m(1) * y + m(2) * z + worldX) / w).toFloat
      val py = ((m(4) * x + m(5) * y + m(6) * z + worldY) / w).toFloat
      val pz = ((m(8) * x + m(9) * y + m(10) * z + worldZ) / w).toFloat
      lowX = Math.min(lowX, px)
      lowY = Math.min(lowY, py)
      lowZ = Math.min(lowZ, pz)
      highX = Math.max(highX, px)
      highY = Math.max(highY, py)
      highZ = Math.max(highZ, pz)
    val world = Bounds3(Vec3(lowX, lowY, lowZ), Vec3(highX, highY, highZ))
    val pad = TriangleSoup.roundingError(world.reach)
    Bounds3(world.min - pad, world.max + pad)

object SurfaceOfRevolution:
  private[shapes] def mapPoint(m: IArray[Double], x: Double, y: Double, z: Double): Vec3 =
    mapPoint(m, m(3), m(7), m(11), x, y, z)

  /** By an affine map with another translation. */
  private def mapPoint(
      m: IArray[Double],
      shiftX: Double,
      shiftY: Double,
      shiftZ: Double,
      x: Double,
      y: Double,
      z: Double
  ): Vec3 =
    Vec3(
      (m(0) * x + m(1) * y + m(2) * z + shiftX).toFloat,
      (m(4) * x + m(5) * y + m(6) * z + shiftY).toFloat,
      (m(8) * x + m(9) * y + m(10) * z + shiftZ).toFloat
    )

  /** As [[Transform.point]], with another translation. */
  private def mapped(
      m: IArray[Double],
      shiftX: Double,
      shiftY: Double,
      shiftZ: Double,
      p: Vec3
  ): Vec3 =
    val x = p.x.toDouble
    val y = p.y.toDouble
    val z = p.z.toDouble
    val w = m(12) * x + m(13) * y + m(14) * z + m(15)
    Vec3(
      ((m(0) * x + m(1) * y + m(2) * z + shiftX) / w).toFloat,
      ((m(4) * x + m(5) * y + m(6) * z + shiftY) / w).toFloat,
      ((m(8) * x + m(9) * y + m(10) * z + shiftZ) / w).toFloat
    )
