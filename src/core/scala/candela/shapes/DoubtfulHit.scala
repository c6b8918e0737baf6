package candela.shapes

import candela.geometry.{Hit, Ray}
import candela.math.*

/** Slow path of [[TriangleTest]], for hits accepted in Float and questionable in Double: triangles
  * that are edge-on, degenerate, or so small and distant that Float can't tell the ray from its
  * neighbours.
  *
  * Sources: the error bound of t from Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd
  * ed., §3.9.6; its effect on boxes, from Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013.
  */
object DoubtfulHit:
  /** Squared sine of the angle between triangle and ray, or between the triangle's sides, from
    * which the Double test has ten digits.
    */
  final val Slim = 1e-12

  /** The same, below which nothing is divided by it. */
  final val Thin = 1e-24

  /** Tolerance of barycentric weights outside the triangle that does not move the point. */
  final val Rounded = 1e-6

  /** Tolerance of barycentric weights outside the triangle that rounding alone explains. */
  private inline val Apart = 1e-3

  /** A corner ahead by at least this fraction of the distance is ahead despite rounding. */
  private inline val Ahead = 1e-5f

  /** Error of a slab's distances caused by the rounding of the Float test: 6 rounding errors. */
  private inline val Slack = 1.0 + 6 * MachineEpsilon

  /** @param e0, e1, e2 edge functions of the Float test
    * @param b1, b2, t  weights and distance of the Double test; undefined if `thin`
    */
  def test(
      v: Array[Float],
      at: Int,
      s: Int,
      primitive: Int,
      ray: Ray,
      hit: Hit,
      e0: Float,
      e1: Float,
      e2: Float,
      b1: Double,
      b2: Double,
      t: Double,
      thin: Boolean,
      write: Boolean
  ): Boolean =
    val isApart = thin || b1 < -Apart || b2 < -Apart || b1 + b2 > 1.0 + Apart
    // A mean of the corners' distances is at least a distance of the triangle
    val somewhere = if isApart then mean(v, at, s, ray, e0, e1, e2) else t
    val tInBox = intoBox(v, at, s, ray, somewhere).toFloat
    if !(tInBox > 0f && TriangleTest.isCloser(tInBox, primitive, ray, hit)) then false
    else if ray.isPrimary && OriginInPlane.test(v, at, s, ray) then false
    else
      if write then
        ray.tMax = tInBox
        if isApart then
          val inv = 1f / (e0 + e1 + e2)
          hit.u = e1 * inv
          hit.v = e2 * inv
        else if Math.min(Math.min(b1, b2), 1.0 - b1 - b2) > -Rounded then
          hit.u = b1
          hit.v = b2
        else
          hit.u = Math.max(0.0, Math.min(1.0, b1))
          hit.v = Math.max(0.0, Math.min(1.0 - hit.u, b2))
      true

  /** Clamps `t` to the ray's interval within the triangle's box; NaN if the ray misses the box. A
    * Float hit may be any distance off an edge-on triangle.
    */
  private def intoBox(v: Array[Float], at: Int, s: Int, ray: Ray, t: Double): Double =
    var near = 0.0
    var far = Double.PositiveInfinity
    var axis = 0
    while axis < 3 do
      val a = v(at + axis * s)
      val b = v(at + (3 + axis) * s)
      val c = v(at + (6 + axis) * s)
      val low = Math.min(a, Math.min(b, c)).toDouble
      val high = Math.max(a, Math.max(b, c)).toDouble
      val pad = (high - low) * TriangleTest.BoxTolerance
      val o = ray.along(axis).toDouble
      val d = if axis == 0 then ray.dx else if axis == 1 then ray.dy else ray.dz
      if d == 0f then
        if o < low - pad || o > high + pad then far = -1.0
      else
        val first = (low - pad - o) / d
        val second = (high + pad - o) / d
        near = Math.max(near, Math.min(first, second))
        far = Math.min(far, Math.max(first, second))
      axis += 1
    if near <= far * Slack then Math.max(near, Math.min(far, t)) else Double.NaN

  /** The Float test's mean of the corners' distances; NaN if it may be behind the origin. */
  private def mean(
      v: Array[Float],
      at: Int,
      s: Int,
      ray: Ray,
      e0: Float,
      e1: Float,
      e2: Float
  ): Double =
    val oz = ray.along(ray.kz)
    val z0 = v(at + ray.kz * s) - oz
    val z1 = v(at + (3 + ray.kz) * s) - oz
    val z2 = v(at + (6 + ray.kz) * s) - oz
    val s0 = z0 * ray.shearZ
    val s1 = z1 * ray.shearZ
    val s2 = z2 * ray.shearZ
    val inv = 1f / (e0 + e1 + e2)
    val t = (e0 * s0 + e1 * s1 + e2 * s2) * inv
    val isAhead = s0 > Ahead * t && s1 > Ahead * t && s2 > Ahead * t
    if isAhead then t
    else
      def sheared(axis: Int, shear: Float): Float = max3(
        Math.abs(v(at + axis * s) - ray.along(axis) + shear * z0),
        Math.abs(v(at + (3 + axis) * s) - ray.along(axis) + shear * z1),
        Math.abs(v(at + (6 + axis) * s) - ray.along(axis) + shear * z2)
      )
      val maxE = max3(Math.abs(e0), Math.abs(e1), Math.abs(e2))
      val maxX = sheared(ray.kx, ray.shearX)
      val maxY = sheared(ray.ky, ray.shearY)
      val tMin = minT(maxX, maxY, max3(Math.abs(s0), Math.abs(s1), Math.abs(s2)), maxE, inv)
      if t > tMin then t else Double.NaN

  /** Lower bound of t to be positive: the rounding error of the test itself. */
  private def minT(maxX: Float, maxY: Float, maxZ: Float, maxE: Float, inv: Float): Float =
    val deltaZ = gamma(3) * maxZ
    val deltaX = gamma(5) * (maxX + maxZ)
    val deltaY = gamma(5) * (maxY + maxZ)
    val deltaE = 2f * (gamma(2) * maxX * maxY + deltaY * maxX + deltaX * maxY)
    3f * (gamma(3) * maxE * maxZ + deltaE * maxZ + deltaZ * maxE) * Math.abs(inv)

  private inline def max3(a: Float, b: Float, c: Float): Float =
    if a > b then (if a > c then a else c) else if b > c then b else c
