package candela.shapes

import candela.geometry.{Hit, Ray}
import candela.math.*

/** Intersects a ray with a curve segment by subdividing it until it is straight.
  *
  * @param normals empty unless the curve is a ribbon; see [[CurveSegments]] for the arrays
  */
private[shapes] final class CurveWalk(
    params: Array[Float],
    widths: Array[Float],
    normals: Array[Float]
):
  private val isRibbon = normals.length > 0

  /** Tests the part s0 to s1 of a segment, with its control points in the ray's space, after
    * `depth` levels of subdivision. (wx, wy, wz) is the ray's unit direction in the curve's space.
    */
  // format: off
  def refine(
      x0: Double, y0: Double, z0: Double,
      x1: Double, y1: Double, z1: Double,
      x2: Double, y2: Double, z2: Double,
      x3: Double, y3: Double, z3: Double,
      s0: Double, s1: Double,
      depth: Int,
      segment: Int,
      wx: Double, wy: Double, wz: Double,
      length: Double,
      ray: Ray,
      hit: Hit,
      write: Boolean
  ): Boolean =
    // format: on
    val w0 = widths(2 * segment).toDouble
    val w1 = widths(2 * segment + 1).toDouble
    val halfWidth = 0.5 * Math.max(w0 + s0 * (w1 - w0), w0 + s1 * (w1 - w0))
    if CurveWalk.apart(y0, y1, y2, y3, halfWidth) || CurveWalk.apart(x0, x1, x2, x3, halfWidth) then
      false
    else if depth > 0 then
      // De Casteljau at the midpoint
      val x01 = 0.5 * (x0 + x1)
      val y01 = 0.5 * (y0 + y1)
      val z01 = 0.5 * (z0 + z1)
      val x12 = 0.5 * (x1 + x2)
      val y12 = 0.5 * (y1 + y2)
      val z12 = 0.5 * (z1 + z2)
      val x23 = 0.5 * (x2 + x3)
      val y23 = 0.5 * (y2 + y3)
      val z23 = 0.5 * (z2 + z3)
      val xa = 0.5 * (x01 + x12)
      val ya = 0.5 * (y01 + y12)
      val za = 0.5 * (z01 + z12)
      val xb = 0.5 * (x12 + x23)
      val yb = 0.5 * (y12 + y23)
      val zb = 0.5 * (z12 + z23)
      val xm = 0.5 * (xa + xb)
      val ym = 0.5 * (ya + yb)
      val zm = 0.5 * (za + zb)
      val sm = 0.5 * (s0 + s1)
      // format: off
      val first = refine(
        x0, y0, z0, x01, y01, z01, xa, ya, za, xm, ym, zm, s0, sm,
        depth - 1, segment, wx, wy, wz, length, ray, hit, write
      )
      // format: on
      if first && !write then true
      else
        // format: off
        val second = refine(
          xm, ym, zm, xb, yb, zb, x23, y23, z23, x3, y3, z3, sm, s1,
          depth - 1, segment, wx, wy, wz, length, ray, hit, write
        )
        // format: on
        first || second
    // Points past the perpendiculars at both ends belong to the neighbouring segments
    else if (y1 - y0) * -y0 + x0 * (x0 - x1) < 0.0 || (y2 - y3) * -y3 + x3 * (x3 - x2) < 0.0 then
      false
    else
      val cx = x3 - x0
      val cy = y3 - y0
      val chord2 = cx * cx + cy * cy
      if !(chord2 > 0.0) then false
      else
        val along = -(x0 * cx + y0 * cy) / chord2
        val w = Math.max(0.0, Math.min(1.0, along))
        val s = s0 + w * (s1 - s0)
        var width = w0 + s * (w1 - w0)
        if isRibbon then width *= facing(segment, curveU(segment, s), wx, wy, wz)
        val m = 1.0 - w
        val b0 = m * m * m
        val b1 = 3.0 * m * m * w
        val b2 = 3.0 * m * w * w
        val b3 = w * w * w
        val x = b0 * x0 + b1 * x1 + b2 * x2 + b3 * x3
        val y = b0 * y0 + b1 * y1 + b2 * y2 + b3 * y3
        val distance2 = x * x + y * y
        if distance2 > 0.25 * width * width then false
        else
          val z = b0 * z0 + b1 * z1 + b2 * z2 + b3 * z3
          val t = z / length
          val stored = t.toFloat
          if !(t > 0.0 && stored < ray.tMax) then false
          else
            if write then
              ray.tMax = stored
              hit.u = curveU(segment, s).toFloat
              // The side of the curve is the sign of its tangent × (vector to the ray)
              val tx = m * m * (x1 - x0) + 2.0 * m * w * (x2 - x1) + w * w * (x3 - x2)
              val ty = m * m * (y1 - y0) + 2.0 * m * w * (y2 - y1) + w * w * (y3 - y2)
              val offset = if width > 0.0 then Math.sqrt(distance2) / width else 0.0
              hit.v = (if x * ty - y * tx > 0.0 then 0.5 + offset else 0.5 - offset).toFloat
            true

  /** The curve's u at a parameter of its segment. */
  inline def curveU(segment: Int, s: Double): Double =
    val u0 = params(2 * segment)
    u0 + s * (params(2 * segment + 1) - u0)

  /** |cos| of the angle between a ribbon's normal at u and the unit direction w. */
  def facing(segment: Int, u: Double, wx: Double, wy: Double, wz: Double): Double =
    val n = normals
    val i = 6 * segment
    val angle = normalAngle(segment)
    val a = CurveWalk.share(1.0 - u, angle)
    val b = CurveWalk.share(u, angle)
    Math.abs(
      (a * n(i) + b * n(i + 3)) * wx + (a * n(i + 1) + b * n(i + 4)) * wy +
        (a * n(i + 2) + b * n(i + 5)) * wz
    )

  /** A ribbon's normal at u. */
  def normal(segment: Int, u: Double): Vec3 =
    val n = normals
    val i = 6 * segment
    val angle = normalAngle(segment)
    val a = CurveWalk.share(1.0 - u, angle).toFloat
    val b = CurveWalk.share(u, angle).toFloat
    Vec3(n(i), n(i + 1), n(i + 2)) * a + Vec3(n(i + 3), n(i + 4), n(i + 5)) * b

  /** Angle between the normals at both ends of a ribbon. */
  private def normalAngle(segment: Int): Double =
    val n = normals
    val i = 6 * segment
    val cosine = n(i).toDouble * n(i + 3) + n(i + 1).toDouble * n(i + 4) +
      n(i + 2).toDouble * n(i + 5)
    Math.acos(Math.max(-1.0, Math.min(1.0, cosine)))

private[shapes] object CurveWalk:

  /** Whether all four coordinates are on one side of zero, farther than `halfWidth`. */
  inline def apart(a: Double, b: Double, c: Double, d: Double, halfWidth: Double): Boolean =
    (a > halfWidth && b > halfWidth && c > halfWidth && d > halfWidth) ||
      (a < -halfWidth && b < -halfWidth && c < -halfWidth && d < -halfWidth)

  /** Largest second difference of four control points, in one coordinate. */
  inline def bend(a: Double, b: Double, c: Double, d: Double): Double =
    Math.max(Math.abs(a - 2 * b + c), Math.abs(b - 2 * c + d))

  /** Subdivision depth at which a curve is straight to a twentieth of its width (the bound of
    * Nakamaru and Ohno, 2002): log4 of √2·6·bend / (8·width/20).
    */
  def depth(bend: Double, halfWidth: Double): Int =
    val ratio = 1.4142135623730951 * 6.0 * bend / (8.0 * 0.1 * halfWidth)
    if !(ratio >= 4.0) then 0 else Math.min(10, Math.getExponent(ratio) / 2)

  /** Weight of an end's normal in spherical interpolation; in linear interpolation if both agree.
    */
  private def share(t: Double, angle: Double): Double =
    if angle > 1e-6 then Math.sin(t * angle) / Math.sin(angle) else t
