package candela.sampling

import candela.math.*

/** A triangle as seen from a point: directions uniform over its solid angle, and the way back from
  * a direction to the square. Doubles inside: the areas are small differences of large angles.
  *
  * Mutable, one per worker: `set` makes it another triangle.
  *
  * Sources: Arvo, "Stratified sampling of spherical triangles", SIGGRAPH 1995; the area by Van
  * Oosterom & Strackee, "The solid angle of a plane triangle", IEEE Trans. Biomed. Eng. 30(2),
  * 1983; the inverse: PBRT 4th ed., §6.5.4.
  */
final class SphericalTriangle:
  import SphericalTriangle.*

  // unit directions to the corners
  private var a, b, c = Direction(0, 0, 1)
  private var cosAB = 0.0
  private var sinAlpha, cosAlpha = 0.0 // of the angle at a
  private var area = 0.0

  /** Sets the triangle `p0`, `p1`, `p2`, seen from `from`.
    *
    * @return can it be sampled? Not if it is seen edge-on, has the eye in its plane or at a corner,
    *         or is smaller than [[MinSolidAngle]]; then sample its surface instead. `sample` and
    *         `invert` need a true answer.
    */
  def set(from: Vec3, p0: Vec3, p1: Vec3, p2: Vec3): Boolean =
    a = towards(from, p0)
    b = towards(from, p1)
    c = towards(from, p2)
    cosAB = a dot b
    // The angle at a is the one between the planes through (a, b) and (a, c).
    val (ab, ac) = (a cross b, a cross c)
    val scale = 1 / (ab.length * ac.length)
    sinAlpha = Math.abs(ab dot c) * scale
    cosAlpha = (ab dot ac) * scale
    area = areaOf(a, b, c)
    // A corner at the eye gives NaN, with which no comparison holds.
    sinAlpha > MinSine && area > MinSolidAngle && area < MaxSolidAngle

  /** In sr. */
  def solidAngle: Float = area.toFloat

  /** The density of `sample`, in sr⁻¹. */
  def pdf: Float = (1 / area).toFloat

  /** The unit direction for a point of the square. */
  def sample(u1: Float, u2: Float): Vec3 =
    // The corner c moves along its arc until the part that is left has the share u1 of the area.
    val part = u1 * area
    val s = Math.sin(part) * cosAlpha - Math.cos(part) * sinAlpha
    val t = Math.cos(part) * cosAlpha + Math.sin(part) * sinAlpha
    val u = t - cosAlpha
    val v = s + sinAlpha * cosAB
    val q = ((v * t - u * s) * cosAlpha - v) / ((v * s + u * t) * sinAlpha)
    val moved = onArc(a, c, Math.max(-1.0, Math.min(1.0, q)))
    // Then from b along the arc to the moved corner, uniformly in the height over b.
    val w = onArc(b, moved, 1 - u2 * (1 - (moved dot b)))
    Vec3(w.x.toFloat, w.y.toFloat, w.z.toFloat)

  /** The (u1, u2, 0) that `sample` takes to the unit direction `w` of the triangle. */
  def invert(w: Vec3): Vec3 =
    val d = Direction(w.x, w.y, w.z)
    // The moved corner lies in the planes through (b, w) and (c, a).
    val line = (b cross d) cross (c cross a)
    if !(line.length > 0) then Vec3.Zero // w is b, where u1 has no meaning
    else
      val moved = line * Math.copySign(1 / line.length, (line dot a) + (line dot c))
      val u1 = areaOf(a, b, moved) / area
      // squared distances from b are twice the heights over it, without their cancellation
      val u2 = (d - b).lengthSquared / (moved - b).lengthSquared
      Vec3(toUnit(u1), toUnit(u2), 0f)

object SphericalTriangle:

  /** In sr. Below this rounding shows, and the density over the surface is as good as constant. */
  val MinSolidAngle: Double = 1e-10

  /** A triangle in a plane that does not hold the eye spans less than the half-space. */
  private val MaxSolidAngle = 2 * Math.PI * (1 - 1e-6)

  /** Below this the sides at a corner coincide within the rounding of Float positions. */
  private inline val MinSine = 1e-7

  private def towards(from: Vec3, p: Vec3): Direction =
    val d = Direction(p.x.toDouble - from.x, p.y.toDouble - from.y, p.z.toDouble - from.z)
    d * (1 / d.length)

  private def areaOf(a: Direction, b: Direction, c: Direction): Double =
    2 * Math.atan2(Math.abs((a cross b) dot c), 1 + (a dot b) + (b dot c) + (c dot a))

  /** The unit vector on the arc from `from` towards `to` that has this cosine with `from`. */
  private def onArc(from: Direction, to: Direction, cosine: Double): Direction =
    val across = to - from * (from dot to)
    val length = across.length
    if length > 0 then
      from * cosine + across * (Math.sqrt(Math.max(0.0, 1 - cosine * cosine)) / length)
    else from

  private def toUnit(x: Double): Float = clamp(x.toFloat, 0f, OneMinusEpsilon)

/** [[Vec3]] with Doubles, as far as spherical triangles need it. */
private final class Direction(val x: Double, val y: Double, val z: Double):
  def +(o: Direction): Direction = Direction(x + o.x, y + o.y, z + o.z)
  def -(o: Direction): Direction = Direction(x - o.x, y - o.y, z - o.z)
  def *(k: Double): Direction = Direction(x * k, y * k, z * k)
  infix def dot(o: Direction): Double = x * o.x + y * o.y + z * o.z
  infix def cross(o: Direction): Direction =
    Direction(y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x)
  def lengthSquared: Double = this dot this
  def length: Double = Math.sqrt(lengthSquared)
