package candela.shapes

import candela.math.*

/** Profile of a quadric of revolution about z: x² + y² = g0 + g1·z + g2·z², from `zMin` to `zMax`.
  * Its v runs along z, from `vStart` over `vSpan`.
  *
  * u = 0 is not always at y = 0: it is in the direction (seamX, seamY) + v·(seamDx, seamDy) of the
  * xy-plane, which rotates along a hyperboloid.
  *
  * @param vSpan negative if v runs downwards; the surface is then inside out
  * @param loose whether the normals are those of the surface that the line swept by the seam makes,
  *   which is another one
  */
final class Profile(
    val g0: Double,
    val g1: Double,
    val g2: Double,
    val zMin: Double,
    val zMax: Double,
    val vStart: Double,
    val vSpan: Double,
    seamX: Double = 1,
    seamY: Double = 0,
    seamDx: Double = 0,
    seamDy: Double = 0,
    val loose: Boolean = false
):
  /** Squared radius; negative where there is no surface. */
  inline def radius2(z: Double): Double = g0 + z * (g1 + z * g2)

  /** Half the derivative of `radius2`: −z of the outward gradient (x, y, −slope) of half the
    * implicit function.
    */
  inline def slope(z: Double): Double = 0.5 * g1 + g2 * z

  /** −z of the normal (x, y, −leaning) that points away from the axis. */
  def leaning(x: Double, y: Double, z: Double): Double =
    if !loose then slope(z)
    else
      val along = alongLine(x, y, z)
      (x * along.x + y * along.y) / vSpan

  /** Where the radius is 0. */
  def zeros: Vector[Double] =
    val root = Math.sqrt(0.25 * g1 * g1 - g0 * g2)
    if g2 == 0 then Option.when(g1 != 0)(-g0 / g1).toVector
    else Vector(-root, root).map(r => (r - 0.5 * g1) / g2).filter(java.lang.Double.isFinite(_))

  inline def v(z: Double): Double = (z - vStart) / vSpan

  /** Angle from the seam to (x, y), in [0, 2π). */
  def angle(x: Double, y: Double, z: Double): Double =
    val t = v(z)
    val sx = seamX + t * seamDx
    val sy = seamY + t * seamDy
    val a = Math.atan2(sx * y - sy * x, sx * x + sy * y)
    if a < 0 then a + 2 * Math.PI else a

  /** Direction of the seam. */
  def seam(z: Double): Double = Math.atan2(seamY + v(z) * seamDy, seamX + v(z) * seamDx)

  /** Derivative of the seam's angle by v. */
  def seamPerV(z: Double): Double =
    val sx = seamX + v(z) * seamDx
    val sy = seamY + v(z) * seamDy
    val length2 = sx * sx + sy * sy
    if length2 > 0 then (sx * seamDy - sy * seamDx) / length2 else 0.0

  /** ∂p/∂v of the line swept by the seam, at the angle of (x, y). */
  def alongLine(x: Double, y: Double, z: Double): Vec3 =
    val a = angle(x, y, z)
    val (c, s) = (Math.cos(a), Math.sin(a))
    Vec3((seamDx * c - seamDy * s).toFloat, (seamDx * s + seamDy * c).toFloat, vSpan.toFloat)

  /** Largest radius. */
  def radius: Double =
    val turn = if g2 < 0 then Math.max(zMin, Math.min(zMax, -0.5 * g1 / g2)) else zMin
    Math.sqrt(Seq(zMin, zMax, turn).map(z => Math.max(0.0, radius2(z))).max)

/** The profiles of pbrt's shapes. */
object Profile:

  def cylinder(radius: Float, zMin: Float, zMax: Float): Profile =
    Profile(radius.toDouble * radius, 0, 0, zMin, zMax, zMin, zMax.toDouble - zMin)

  /** From z = 0, with radius `radius`, to the apex at `height`. */
  def cone(radius: Float, height: Float): Profile =
    val r2 = radius.toDouble * radius
    val h = height.toDouble
    Profile(r2, -2 * r2 / h, r2 / (h * h), 0, h, 0, h)

  /** With its apex at the origin, and radius `radius` at `zMax`. */
  def paraboloid(radius: Float, zMin: Float, zMax: Float): Profile =
    Profile(0, radius.toDouble * radius / zMax, 0, zMin, zMax, zMin, zMax.toDouble - zMin)

  def sphere(radius: Float, zMin: Float, zMax: Float): Profile =
    Profile(radius.toDouble * radius, 0, -1, zMin, zMax, zMin, zMax.toDouble - zMin)

  /** The surface that the line from `a` to `b` sweeps, if the line is closest to the z-axis at z =
    * 0. A quadric that is symmetric about z = 0 can't follow other lines; as in pbrt it then passes
    * through b and through a + 2k·(b − a) for the first k = 1, 2 whose distance from the plane z =
    * 0 differs, and has the normals of the line's surface.
    *
    * @return None if both points have the same z
    */
  def hyperboloid(a: Vec3, b: Vec3): Option[Profile] =
    val (p1, p2) = if b.z == 0f then (b, a) else (a, b)
    val x = p1.x.toDouble
    val y = p1.y.toDouble
    val z = p1.z.toDouble
    val dx = p2.x - x
    val dy = p2.y - y
    val dz = p2.z - z
    val z2 = p2.z.toDouble * p2.z
    val s2 = p2.x.toDouble * p2.x + p2.y.toDouble * p2.y
    val secondPoint = Seq(2, 4)
      .map(k => (square(z + k * dz), square(x + k * dx) + square(y + k * dy)))
      .find((zz, _) => Math.abs(zz - z2) > 1e-6 * z2)
    for (zz, ss) <- secondPoint if dz != 0 yield
      val g2 = (ss - s2) / (zz - z2)
      val g0 = s2 - g2 * z2
      Profile(
        g0,
        0,
        g2,
        Math.min(p1.z, p2.z),
        Math.max(p1.z, p2.z),
        z,
        dz,
        x,
        y,
        dx,
        dy,
        loose = !isAlike(g0 + g2 * z * z, x * x + y * y, Math.max(s2, x * x + y * y))
      )

  /** To a thousandth of the larger squared radius. */
  private def isAlike(a: Double, b: Double, largest: Double) = Math.abs(a - b) <= 1e-3 * largest
