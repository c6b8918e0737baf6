package candela.shapes

import candela.geometry.Ray
import candela.math.*

/** Whether a ray starts in the plane of a triangle, as far as Floats can tell. What such a ray hits
  * at its origin is no hit: exporters put cameras into the plane of a surface, exactly but for
  * rounding, and expect to look along it.
  *
  * The test asks for the distance to the plane, not for that of the hit: each coordinate of origin
  * and corners moves it by its rounding, times that of the normal. A camera close above a large
  * floor is therefore not in its plane, if the floor is level.
  *
  * pbrt rejects hits below the error of its own arithmetic, about as large (Pharr, Jakob,
  * Humphreys, "Physically Based Rendering", 4th ed., §6.8.7).
  */
private[shapes] object OriginInPlane:

  /** Rounding of a coordinate that a few transforms have moved. */
  private final val Rounding = 8 * MachineEpsilon

  /** @param v, at, s as in [[TriangleTest]] */
  def test(v: Array[Float], at: Int, s: Int, ray: Ray): Boolean =
    inline def corner(k: Int, axis: Int): Double = v(at + (3 * k + axis) * s).toDouble
    inline def side(k: Int, axis: Int): Double = corner(k, axis) - corner(0, axis)
    inline def normal(j: Int, k: Int): Double = side(1, j) * side(2, k) - side(1, k) * side(2, j)
    inline def size(axis: Int, o: Float): Double = Math.abs(o) +
      Math.max(
        Math.abs(corner(0, axis)),
        Math.max(Math.abs(corner(1, axis)), Math.abs(corner(2, axis)))
      )
    val nx = normal(1, 2)
    val ny = normal(2, 0)
    val nz = normal(0, 1)
    val distance = nx * (ray.ox - corner(0, 0)) + ny * (ray.oy - corner(0, 1)) +
      nz * (ray.oz - corner(0, 2))
    val error = Math.abs(nx) * size(0, ray.ox) + Math.abs(ny) * size(1, ray.oy) +
      Math.abs(nz) * size(2, ray.oz)
    Math.abs(distance) <= Rounding * error
