package candela.shapes

import candela.geometry.{Hit, Ray}
import candela.math.magnitudeBits

/** Watertight ray–triangle test: a ray through an edge or vertex of a closed mesh always hits one
  * of the triangles that share it.
  *
  * Every accepted hit lies, to a relative [[BoxTolerance]], inside the triangle's box: any BVH
  * finds exactly the hits of the brute-force test.
  *
  * Source: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013.
  */
object TriangleTest:

  /** Tests the nine Floats of `v` from `at` on: the corners' coordinates. On a hit in (0,
    * `ray.tMax`) shortens the ray, writes the barycentric weights, and returns true.
    */
  def intersect(v: Array[Float], at: Int, ray: Ray, hit: Hit): Boolean =
    test(v, at, 1, Int.MaxValue, ray, hit, write = true)

  /** As above, for Floats at a distance of `stride`. Of two triangles at the same distance the
    * lower `number` wins, so that the result does not depend on traversal order: `hit.primitive` is
    * the number of the closest hit so far, or −1.
    */
  def intersect(
      v: Array[Float],
      at: Int,
      stride: Int,
      primitive: Int,
      ray: Ray,
      hit: Hit
  ): Boolean =
    test(v, at, stride, primitive, ray, hit, write = true)

  /** As `intersect`, leaving ray and hit unchanged. */
  def isHit(v: Array[Float], at: Int, ray: Ray, hit: Hit): Boolean =
    test(v, at, 1, Int.MaxValue, ray, hit, write = false)

  def isHit(v: Array[Float], at: Int, stride: Int, ray: Ray, hit: Hit): Boolean =
    test(v, at, stride, Int.MaxValue, ray, hit, write = false)

  /** As `intersect`, for a triangle whose edge functions in Float are known to be all positive or
    * all negative, none of them zero.
    */
  inline def intersectInside(
      v: Array[Float],
      at: Int,
      inline stride: Int,
      primitive: Int,
      ray: Ray,
      hit: Hit
  ): Boolean =
    decide(v, at, stride, primitive, ray, hit, write = true): (_, _, _, _) =>
      intersect(v, at, stride, primitive, ray, hit)

  /** As `intersectInside`, leaving ray and hit unchanged. */
  inline def isHitInside(
      v: Array[Float],
      at: Int,
      inline stride: Int,
      ray: Ray,
      hit: Hit
  ): Boolean =
    decide(v, at, stride, Int.MaxValue, ray, hit, write = false): (_, _, _, _) =>
      isHit(v, at, stride, ray, hit)

  /** Tolerance of a hit outside the triangle's box, relative to its extent along each axis. */
  final val BoxTolerance = 2e-6f

  private inline def test(
      v: Array[Float],
      at: Int,
      s: Int,
      primitive: Int,
      ray: Ray,
      hit: Hit,
      inline write: Boolean
  ): Boolean =
    val kx = ray.kx
    val ky = ray.ky
    val kz = ray.kz
    val ox = ray.oAlongX
    val oy = ray.oAlongY
    val oz = ray.oAlongZ
    // Transforms to ray space, with origin 0 and direction +z: shears x and y now, scales z at the
    // end. Kernels that test several triangles at once repeat this, operation by operation
    val z0 = v(at + kz * s) - oz
    val z1 = v(at + (3 + kz) * s) - oz
    val z2 = v(at + (6 + kz) * s) - oz
    val x0 = v(at + kx * s) - ox + ray.shearX * z0
    val y0 = v(at + ky * s) - oy + ray.shearY * z0
    val x1 = v(at + (3 + kx) * s) - ox + ray.shearX * z1
    val y1 = v(at + (3 + ky) * s) - oy + ray.shearY * z1
    val x2 = v(at + (6 + kx) * s) - ox + ray.shearX * z2
    val y2 = v(at + (6 + ky) * s) - oy + ray.shearY * z2
    var e0 = x1 * y2 - y1 * x2
    var e1 = x2 * y0 - y2 * x0
    var e2 = x0 * y1 - y0 * x1
    // Conditions by the signs of bits, one branch each: the JVM compiles a method again when a
    // branch is taken for the first time
    if isAnyZero(e0, e1, e2) then
      // On an edge in Float: products of Floats are exact in Double, so the sign is right
      e0 = (x1.toDouble * y2.toDouble - y1.toDouble * x2.toDouble).toFloat
      e1 = (x2.toDouble * y0.toDouble - y2.toDouble * x0.toDouble).toFloat
      e2 = (x0.toDouble * y1.toDouble - y0.toDouble * x1.toDouble).toFloat
    if areMixed(e0, e1, e2) || e0 + e1 + e2 == 0f then false
    else
      decide(v, at, s, primitive, ray, hit, write): (b1, b2, t, thin) =>
        DoubtfulHit.test(v, at, s, primitive, ray, hit, e0, e1, e2, b1, b2, t, thin, write)

  /** Decides in Double about a hit that the edge functions allow.
    *
    * @param doubtful decides instead where Double cannot: receives weights, distance, and whether
    *                 these are undefined
    */
  private inline def decide(
      v: Array[Float],
      at: Int,
      inline s: Int,
      primitive: Int,
      ray: Ray,
      hit: Hit,
      inline write: Boolean
  )(inline doubtful: (Double, Double, Double, Boolean) => Boolean): Boolean =
    // The hit is recomputed in Double from the corners (Möller and Trumbore, "Fast, Minimum
    // Storage Ray/Triangle Intersection", JGT 2(1), 1997): Floats are off by 1e-7 of the distance
    // to the farthest corner, too much close to a large triangle and for a small distant one
    val px = v(at).toDouble
    val py = v(at + s).toDouble
    val pz = v(at + 2 * s).toDouble
    val ax = v(at + 3 * s) - px
    val ay = v(at + 4 * s) - py
    val az = v(at + 5 * s) - pz
    val bx = v(at + 6 * s) - px
    val by = v(at + 7 * s) - py
    val bz = v(at + 8 * s) - pz
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
    val t = (bx * rx + by * ry + bz * rz) * inverse
    val sides = (ax * ax + ay * ay + az * az) * (bx * bx + by * by + bz * bz) *
      (dx * dx + dy * dy + dz * dz)
    val isClear = areSigns(
      DoubtfulHit.Slim * sides - volume * volume,
      b1 + DoubtfulHit.Rounded,
      b2 + DoubtfulHit.Rounded,
      1.0 + DoubtfulHit.Rounded - (b1 + b2)
    )
    if !isClear then doubtful(b1, b2, t, volume * volume <= DoubtfulHit.Thin * sides)
    else
      val end = t.toFloat
      if !(end > 0f && isCloser(end, primitive, ray, hit)) then false
      else if ray.isPrimary && OriginInPlane.test(v, at, s, ray) then false
      else
        if write then
          ray.tMax = end
          // Clamped to the edge, a point on a plane 1e6 wide would move by hundredths
          hit.u = b1
          hit.v = b2
        true

  private[shapes] inline def isAnyZero(a: Float, b: Float, c: Float): Boolean =
    ((magnitudeBits(a) - 1) | (magnitudeBits(b) - 1) | (magnitudeBits(c) - 1)) < 0

  /** Whether one is below and another one above zero. */
  private[shapes] inline def areMixed(a: Float, b: Float, c: Float): Boolean =
    val below = (bits(a) & sided(a)) | (bits(b) & sided(b)) | (bits(c) & sided(c))
    val above = (~bits(a) & sided(a)) | (~bits(b) & sided(b)) | (~bits(c) & sided(c))
    (below & above) < 0

  /** Negative if x is neither zero nor NaN. */
  private inline def sided(x: Float): Int = -magnitudeBits(x) & (magnitudeBits(x) - NaN)

  private inline def bits(x: Float): Int = java.lang.Float.floatToRawIntBits(x)

  /** Whether `below` has a minus sign, and the others have none. */
  private inline def areSigns(below: Double, a: Double, b: Double, c: Double): Boolean =
    (sign(below) & ~(sign(a) | sign(b) | sign(c))) < 0L

  /** The smallest bits of a NaN without its sign. */
  private inline val NaN = 0x7f800001

  private inline def sign(x: Double): Long = java.lang.Double.doubleToRawLongBits(x)

  /** Whether a hit at t > 0 precedes the closest one so far: a comparison of pairs. */
  inline def isCloser(t: Float, primitive: Int, ray: Ray, hit: Hit): Boolean =
    t <= ray.tMax && pair(t, primitive) < pair(ray.tMax, hit.primitive)

  private inline def pair(t: Float, primitive: Int): Long =
    (bits(t).toLong << 32) + (primitive.toLong - Int.MinValue)
