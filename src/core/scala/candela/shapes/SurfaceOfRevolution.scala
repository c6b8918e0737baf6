package candela.shapes

import candela.base.loop
import candela.geometry.{Bounds3, Ray, ShadingPoint}
import candela.math.*

/** A surface of revolution about the z-axis of object space, optionally partial, under any affine
  * transform. Common base: transforms rays to object space in Double, and points to world space.
  *
  * @param radius upper bound of its radius, in object space
  * @param reach  upper bound of |z|, in object space
  */
abstract class SurfaceOfRevolution(objectToWorld: Transform, radius: Double, reach: Double)
    extends Shape:
  private val toWorld = objectToWorld.m

  override def bendsAsSeen: Boolean = true
  private val toObject = objectToWorld.inverseM

  /** Largest error, per component, of a point in a box of this half extent around the origin of
    * object space, caused by Double arithmetic on the way to world space and back: some 2⁶ rounding
    * errors of the largest number involved. It matters for points close to the world's origin, as
    * on a ground that is a sphere of radius 1e6.
    */
  protected final val doubleError: Vec3 =
    def row(r: Int) =
      (1.4e-14 * (Math.abs(toWorld(r)) * radius + Math.abs(toWorld(r + 1)) * radius +
        Math.abs(toWorld(r + 2)) * reach + Math.abs(toWorld(r + 3)))).toFloat
    Vec3(row(0), row(4), row(8))

  // A world-space point in object space

  protected final def objectX(x: Double, y: Double, z: Double): Double = point(0, x, y, z)
  protected final def objectY(x: Double, y: Double, z: Double): Double = point(4, x, y, z)
  protected final def objectZ(x: Double, y: Double, z: Double): Double = point(8, x, y, z)

  private def point(row: Int, x: Double, y: Double, z: Double): Double =
    val m = toObject
    m(row) * x + m(row + 1) * y + m(row + 2) * z + m(row + 3)

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

  protected final def isWithin(ray: Ray, t: Double): Boolean = t > 0.0 && t < ray.tMax

  /** Distance of the hit that shortened a ray to `t`, recomputed in Double; `t` itself if `found`
    * is another hit, as behind an alpha cutout.
    */
  protected final def refined(found: Double, t: Float): Double =
    if Math.abs(found - t) <= 1e-6 * t then found else t.toDouble

  /** Sets the point from object space, with its error bound in world space. */
  protected final def put(x: Double, y: Double, z: Double, at: ShadingPoint): Unit =
    at.p = SurfaceOfRevolution.place(toWorld, x, y, z)
    at.pError = TriangleSoup.roundingError(at.p) + doubleError

  protected final def put(x: Double, y: Double, z: Double, out: SurfaceSample): Unit =
    out.p = SurfaceOfRevolution.place(toWorld, x, y, z)
    out.pError = TriangleSoup.roundingError(out.p) + doubleError

  /** Angle around the z-axis, from 0 to 2π. */
  protected final def phi(x: Double, y: Double): Double =
    val a = Math.atan2(y, x)
    if a < 0 then a + 2 * Math.PI else a

  /** World bounds of the cylinder |x|, |y| ≤ radius, zMin ≤ z ≤ zMax. */
  protected final def worldBounds(radius: Float, zMin: Float, zMax: Float): Bounds3 =
    val box = Bounds3(Vec3(-radius, -radius, zMin), Vec3(radius, radius, zMax))
    var world = Bounds3.Empty
    loop(8)(i => world = world.union(objectToWorld.point(box.corner(i))))
    def reach(axis: Int) = Math.max(Math.abs(world.min(axis)), Math.abs(world.max(axis)))
    val pad = TriangleSoup.roundingError(Vec3(reach(0), reach(1), reach(2)))
    Bounds3(world.min - pad, world.max + pad)

object SurfaceOfRevolution:
  private[shapes] def place(m: IArray[Double], x: Double, y: Double, z: Double): Vec3 =
    Vec3(
      (m(0) * x + m(1) * y + m(2) * z + m(3)).toFloat,
      (m(4) * x + m(5) * y + m(6) * z + m(7)).toFloat,
      (m(8) * x + m(9) * y + m(10) * z + m(11)).toFloat
    )
