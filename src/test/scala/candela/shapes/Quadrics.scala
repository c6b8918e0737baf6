package candela.shapes

import candela.math.*
import candela.testing.Draws

/** A quadric to test with, beside its definition as a swept line: (u, v) to object space.
  *
  * @param implicit_ zero on the surface, growing outwards
  */
final case class SweptQuadric(
    name: String,
    profile: Profile,
    phiMax: Float,
    size: Float,
    point: (Double, Double) => Array[Double],
    implicit_ : Array[Double] => Double
):
  def placed(toWorld: Transform, reversed: Boolean = false): Quadric =
    Quadric(toWorld, profile, phiMax, reversed)

object Quadrics:
  private def swept(phi: Double, r: Double, z: Double) =
    Array(r * Math.cos(phi), r * Math.sin(phi), z)

  private def sq(x: Double) = x * x

  def cylinder(r: Float, zMin: Float, zMax: Float, phi: Float): SweptQuadric =
    SweptQuadric(
      "cylinder",
      Profile.cylinder(r, zMin, zMax),
      phi,
      r.max(zMax - zMin),
      (u, v) => swept(u * phi, r, zMin + v * (zMax.toDouble - zMin)),
      p => p(0) * p(0) + p(1) * p(1) - r.toDouble * r
    )

  def cone(r: Float, h: Float, phi: Float): SweptQuadric =
    SweptQuadric(
      "cone",
      Profile.cone(r, h),
      phi,
      r.max(h),
      (u, v) => swept(u * phi, r * (1 - v), v * h),
      p => p(0) * p(0) + p(1) * p(1) - sq(r.toDouble / h * (p(2) - h))
    )

  def paraboloid(r: Float, zMin: Float, zMax: Float, phi: Float): SweptQuadric =
    SweptQuadric(
      "paraboloid",
      Profile.paraboloid(r, zMin, zMax),
      phi,
      r.max(zMax - zMin),
      (u, v) =>
        val z = zMin + v * (zMax.toDouble - zMin)
        swept(u * phi, r * Math.sqrt(z / zMax), z)
      ,
      p => p(0) * p(0) + p(1) * p(1) - p(2) * r.toDouble * r / zMax
    )

  /** Of a line that is nearest to the z-axis at z = 0, at `waist` on the x-axis. */
  def hyperboloid(waist: Float, tilt: Float, z1: Float, z2: Float, phi: Float): SweptQuadric =
    def at(z: Float) = Vec3(waist, tilt * z, z)
    SweptQuadric(
      "hyperboloid",
      Profile.hyperboloid(at(z1), at(z2)).get,
      phi,
      waist.max(Math.abs(z1 - z2)),
      (u, v) =>
        val z = z1 + v * (z2.toDouble - z1)
        val (c, s) = (Math.cos(u * phi), Math.sin(u * phi))
        Array(waist * c - tilt * z * s, waist * s + tilt * z * c, z)
      ,
      p => p(0) * p(0) + p(1) * p(1) - waist.toDouble * waist - sq(tilt.toDouble * p(2))
    )

  /** One of each kind, of about `size`. */
  def random(draws: Draws, kind: Int, size: Float): SweptQuadric =
    def part() = size * draws.between(0.2f, 1)
    val phi = if draws.coin() then TwoPi else draws.between(0.5f, 6)
    kind % 4 match
      case 0 => cylinder(part(), -part(), part(), phi)
      case 1 => cone(part(), part(), phi)
      case 2 =>
        val top = part()
        paraboloid(part(), if draws.coin() then 0f else top * draws.between(0, 0.8f), top, phi)
      case _ => hyperboloid(part(), draws.between(-1.5f, 1.5f), -part(), part(), phi)

  /** Likewise, of a full turn. */
  def whole(draws: Draws, kind: Int, size: Float): SweptQuadric =
    val some = random(draws, kind, size)
    if some.phiMax == TwoPi then some else whole(draws, kind, size)
