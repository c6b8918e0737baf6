package candela.shapes

import candela.geometry.{Hit, Ray}
import candela.math.*

/** The ray–triangle test: watertight, so that a ray through a closed mesh's edge or vertex always
  * meets one of the triangles that share it.
  *
  * Sources: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013; the bound
  * on the error of t from Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd ed., §3.9.6.
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
    if (e0 < 0f || e1 < 0f || e2 < 0f) && (e0 > 0f || e1 > 0f || e2 > 0f) then false
    else
      val det = e0 + e1 + e2
      val s0 = z0 * ray.shearZ
      val s1 = z1 * ray.shearZ
      val s2 = z2 * ray.shearZ
      val scaled = e0 * s0 + e1 * s1 + e2 * s2
      val limit = ray.tMax * det
      val outside =
        if det < 0f then scaled >= 0f || scaled < limit
        else if det > 0f then scaled <= 0f || scaled > limit
        else true
      if outside then false
      else
        val inv = 1f / det
        val t = scaled * inv
        if t <= minT(x0, y0, s0, x1, y1, s1, x2, y2, s2, e0, e1, e2, inv) then false
        else
          if write then
            ray.tMax = t
            hit.u = e1 * inv
            hit.v = e2 * inv
          true

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
