package candela.shapes

import candela.geometry.{Hit, Ray}
import candela.math.*

/** The ray–triangle test: watertight, so that a ray through a closed mesh's edge or vertex always
  * meets one of the triangles that share it.
  *
  * Sources: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013; the bound
  * on the error of t, where there is one, from Pharr, Jakob, Humphreys, "Physically Based
  * Rendering", 3rd ed., §3.9.6.
  */
object TriangleTest:

  /** Tests the nine Floats of `v` from `at` on: the corners' coordinates. On a hit in (0,
    * `ray.tMax`) shortens the ray, writes the barycentric weights, and is true.
    */
  def intersect(v: Array[Float], at: Int, ray: Ray, hit: Hit): Boolean =
    test(v, at, ray, hit, write = true)

  /** As `intersect`, leaving ray and hit alone. */
  def isHit(v: Array[Float], at: Int, ray: Ray, hit: Hit): Boolean =
    test(v, at, ray, hit, write = false)

  private inline def origin(ray: Ray, axis: Int): Float =
    if axis == 0 then ray.ox else if axis == 1 then ray.oy else ray.oz

  private inline def test(
      v: Array[Float],
      at: Int,
      ray: Ray,
      hit: Hit,
      inline write: Boolean
  ): Boolean =
    val kx = ray.kx
    val ky = ray.ky
    val kz = ray.kz
    val ox = origin(ray, kx)
    val oy = origin(ray, ky)
    val oz = origin(ray, kz)
    // Into the space where the ray starts at 0 and runs along +z: shear x and y now, z at the end
    val z0 = v(at + kz) - oz
    val z1 = v(at + 3 + kz) - oz
    val z2 = v(at + 6 + kz) - oz
    val x0 = v(at + kx) - ox + ray.shearX * z0
    val y0 = v(at + ky) - oy + ray.shearY * z0
    val x1 = v(at + 3 + kx) - ox + ray.shearX * z1
    val y1 = v(at + 3 + ky) - oy + ray.shearY * z1
    val x2 = v(at + 6 + kx) - ox + ray.shearX * z2
    val y2 = v(at + 6 + ky) - oy + ray.shearY * z2
    var e0 = x1 * y2 - y1 * x2
    var e1 = x2 * y0 - y2 * x0
    var e2 = x0 * y1 - y0 * x1
    if e0 == 0f || e1 == 0f || e2 == 0f then
      // On an edge in Float: products of Floats are exact in Double, so the sign is right
      e0 = (x1.toDouble * y2.toDouble - y1.toDouble * x2.toDouble).toFloat
      e1 = (x2.toDouble * y0.toDouble - y2.toDouble * x0.toDouble).toFloat
      e2 = (x0.toDouble * y1.toDouble - y0.toDouble * x1.toDouble).toFloat
    val det = e0 + e1 + e2
    if ((e0 < 0f || e1 < 0f || e2 < 0f) && (e0 > 0f || e1 > 0f || e2 > 0f)) || det == 0f then false
    else
      // The ray goes through. Where, is found anew in Double from the corners as they are (Möller
      // and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", JGT 2(1), 1997): Floats
      // are
      // off by 1e-7 of the way to the farthest corner, which is too much close to a large triangle
      // and for a small one far away
      val px = v(at).toDouble
      val py = v(at + 1).toDouble
      val pz = v(at + 2).toDouble
      val ax = v(at + 3) - px
      val ay = v(at + 4) - py
      val az = v(at + 5) - pz
      val bx = v(at + 6) - px
      val by = v(at + 7) - py
      val bz = v(at + 8) - pz
      val dx = ray.dx.toDouble
      val dy = ray.dy.toDouble
      val dz = ray.dz.toDouble
      val qx = dy * bz - dz * by
      val qy = dz * bx - dx * bz
      val qz = dx * by - dy * bx
      val volume = ax * qx + ay * qy + az * qz
      val inverse = 1.0 / volume
      val sx = ray.ox - px
      val sy = ray.oy - py
      val sz = ray.oz - pz
      val rx = sy * az - sz * ay
      val ry = sz * ax - sx * az
      val rz = sx * ay - sy * ax
      val b1 = (sx * qx + sy * qy + sz * qz) * inverse
      val b2 = (dx * rx + dy * ry + dz * rz) * inverse
      val thin = volume * volume <= Thin * ((ax * ax + ay * ay + az * az) *
        (bx * bx + by * by + bz * bz) * (dx * dx + dy * dy + dz * dz))
      if thin || b1 < -Apart || b2 < -Apart || b1 + b2 > 1.0 + Apart then
        // Seen edge-on or without an area, or so small and far that Floats can't tell the ray from
        // its neighbours: a mean of the corners' distances is at least one of the triangle
        val s0 = z0 * ray.shearZ
        val s1 = z1 * ray.shearZ
        val s2 = z2 * ray.shearZ
        val inv = 1f / det
        val t = (e0 * s0 + e1 * s1 + e2 * s2) * inv
        val isAhead = s0 > Ahead * t && s1 > Ahead * t && s2 > Ahead * t
        if !(t > 0f && t < ray.tMax) then false
        else if !isAhead && t <= minT(x0, y0, s0, x1, y1, s1, x2, y2, s2, e0, e1, e2, inv) then
          false
        else
          if write then
            ray.tMax = t
            hit.u = e1 * inv
            hit.v = e2 * inv
          true
      else
        val t = (bx * rx + by * ry + bz * rz) * inverse
        if !(t > 0.0 && t < ray.tMax) then false
        else
          if write then
            ray.tMax = t.toFloat
            if Math.min(Math.min(b1, b2), 1.0 - b1 - b2) > -Rounded then
              // Held to the edge, a point on a plane 1e6 wide would move by hundredths
              hit.u = b1
              hit.v = b2
            else
              hit.u = Math.max(0.0, Math.min(1.0, b1))
              hit.v = Math.max(0.0, Math.min(1.0 - hit.u, b2))
          true

  /** The square of the sine under which a triangle is seen, or of that between its sides, below
    * which nothing is divided by it.
    */
  private inline val Thin = 1e-24

  /** By how much barycentric weights may be outside and the point stay where it is. */
  private inline val Rounded = 1e-6

  /** By how much barycentric weights may be outside for reasons of rounding alone. */
  private inline val Apart = 1e-3

  /** A corner that is at least so much of the distance ahead is ahead, whatever was rounded. */
  private inline val Ahead = 1e-5f

  /** What t must exceed to be surely positive: the rounding error of the test itself. */
  private inline def minT(
      x0: Float,
      y0: Float,
      z0: Float,
      x1: Float,
      y1: Float,
      z1: Float,
      x2: Float,
      y2: Float,
      z2: Float,
      e0: Float,
      e1: Float,
      e2: Float,
      inv: Float
  ): Float =
    val maxZ = max3(Math.abs(z0), Math.abs(z1), Math.abs(z2))
    val maxX = max3(Math.abs(x0), Math.abs(x1), Math.abs(x2))
    val maxY = max3(Math.abs(y0), Math.abs(y1), Math.abs(y2))
    val deltaZ = gamma(3) * maxZ
    val deltaX = gamma(5) * (maxX + maxZ)
    val deltaY = gamma(5) * (maxY + maxZ)
    val deltaE = 2f * (gamma(2) * maxX * maxY + deltaY * maxX + deltaX * maxY)
    val maxE = max3(Math.abs(e0), Math.abs(e1), Math.abs(e2))
    3f * (gamma(3) * maxE * maxZ + deltaE * maxZ + deltaZ * maxE) * Math.abs(inv)

  private inline def max3(a: Float, b: Float, c: Float): Float =
    if a > b then (if a > c then a else c) else if b > c then b else c
