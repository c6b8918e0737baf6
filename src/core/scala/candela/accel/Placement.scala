package candela.accel

import candela.base.loop
import candela.geometry.{Bounds3, Frame, Ray, ShadingPoint}
import candela.math.*

/** Transforms of instances, from the 24 Doubles that [[candela.math.Motion]] writes: three rows of
  * object to world, three of its inverse. Affine maps only.
  */
object Placement:
  private[accel] inline val Inverse = 12

  /** Area before the map per area after it, of a surface that has the unit normal `n` after it:
    * |Mᵀ n| / |det M|.
    */
  private[accel] def shrinkage(m: Array[Double], at: Int, n: Vec3): Float =
    def along(column: Int): Double =
      m(at + column) * n.x + m(at + 4 + column) * n.y + m(at + 8 + column) * n.z
    val (x, y, z) = (along(0), along(1), along(2))
    (Math.sqrt(x * x + y * y + z * z) / Math.abs(determinant(m, at))).toFloat

  private[accel] def determinant(m: Array[Double], at: Int): Double =
    m(at) * (m(at + 5) * m(at + 10) - m(at + 6) * m(at + 9)) -
      m(at + 1) * (m(at + 4) * m(at + 10) - m(at + 6) * m(at + 8)) +
      m(at + 2) * (m(at + 4) * m(at + 9) - m(at + 5) * m(at + 8))

  /** Transforms the ray to object space; the result is `ray.nested`, with the same distances.
    *
    * @param i where the rows of world to object begin
    */
  def enter(m: Array[Double], i: Int, ray: Ray): Ray =
    val local = ray.nested
    val ox = ray.ox.toDouble
    val oy = ray.oy.toDouble
    val oz = ray.oz.toDouble
    val dx = ray.dx.toDouble
    val dy = ray.dy.toDouble
    val dz = ray.dz.toDouble
    local.set(
      (m(i) * ox + m(i + 1) * oy + m(i + 2) * oz + m(i + 3)).toFloat,
      (m(i + 4) * ox + m(i + 5) * oy + m(i + 6) * oz + m(i + 7)).toFloat,
      (m(i + 8) * ox + m(i + 9) * oy + m(i + 10) * oz + m(i + 11)).toFloat,
      (m(i) * dx + m(i + 1) * dy + m(i + 2) * dz).toFloat,
      (m(i + 4) * dx + m(i + 5) * dy + m(i + 6) * dz).toFloat,
      (m(i + 8) * dx + m(i + 9) * dy + m(i + 10) * dz).toFloat,
      ray.tMax
    )
    local.isPrimary = ray.isPrimary
    local

  /** Bounds of the transformed object box, including the rounding of transformed rays. */
  def bounds(m: Array[Double], at: Int, box: Bounds3): Bounds3 =
    if box.isEmpty then Bounds3.Empty else bounds(m, at, box, new Array[Float](Corners))

  /** @param corners where the transformed corners of the box, which is not empty, are written */
  private def bounds(m: Array[Double], at: Int, box: Bounds3, corners: Array[Float]): Bounds3 =
    loop(8): c =>
      val p = point(m, at, box.corner(c))
      corners(3 * c) = p.x
      corners(3 * c + 1) = p.y
      corners(3 * c + 2) = p.z
    inline def extreme(axis: Int)(inline of: (Float, Float) => Float): Float =
      var value = corners(axis)
      loop(1, 8)(c => value = of(value, corners(3 * c + axis)))
      value
    inline def extremes(inline of: (Float, Float) => Float) =
      Vec3(extreme(0)(of), extreme(1)(of), extreme(2)(of))
    val hull = Bounds3(extremes(Math.min(_, _)), extremes(Math.max(_, _)))
    val pad = stretched(m, at, box.reach) * gamma(2) + hull.reach * gamma(2)
    Bounds3(hull.min - pad, hull.max + pad)

  /** Bounds of the object's box over the shutter interval.
    *
    * Between two sampled times, a corner deviates from the chord by an eighth of the squared step
    * times its acceleration, an eighth of the second difference of its positions. The bounds are
    * padded by four times that. Rotations are sampled in steps of 2.8 degrees.
    */
  def bounds(motion: Motion, open: Float, close: Float, box: Bounds3): Bounds3 =
    if box.isEmpty then Bounds3.Empty
    else
      val m = new Array[Double](Motion.Work)
      var swept = Bounds3.Empty
      // Without an object for each corner: there may be millions of motions
      val corners = Array.fill(3)(new Array[Float](Corners))
      val difference = new Array[Float](3)
      // A second difference has three moments
      val angle = motion.rotationRate() * (close - open)
      val steps = clamp(Math.ceil(angle / StepAngle).toInt, 2, MaxSteps)
      loop(steps + 1): k =>
        motion.write(lerp(k.toFloat / steps, open, close), m, 0)
        val (current, previous, earlier) =
          (corners(k % 3), corners((k + 2) % 3), corners((k + 1) % 3))
        swept = swept.union(bounds(m, 0, box, current))
        if k > 1 then
          loop(Corners): i =>
            val d = Math.abs(earlier(i) + current(i) - previous(i) * 2f)
            difference(i % 3) = Math.max(difference(i % 3), d)
      val pad = Vec3(difference(0), difference(1), difference(2)) * 0.5f
      Bounds3(swept.min - pad, swept.max + pad)

  /** Coordinates of a box's corners. */
  private inline val Corners = 24

  private inline val StepAngle = Math.PI / 64

  /** What moves faster is seen in hardly any sample. */
  private inline val MaxSteps = 1 << 12

  /** Transforms a shading point from object to world space.
    *
    * The point's error bound is the transformed error, plus the transformed rounding of a ray
    * origin that returns to object space, plus the point's own rounding. The geometric normal keeps
    * the object's outside even if the map swaps handedness; the shading normal follows it (as in
    * pbrt-v2, v3 and v4).
    */
  def locate(m: Array[Double], at: Int, s: ShadingPoint): Unit =
    val rounding = s.pError + absolute(s.p) * gamma(1)
    s.p = point(m, at, s.p)
    // Far from the world's origin, or near it inside a large object, Double rounding matters too
    val inverse = at + Inverse
    val error = rounding +
      (stretched(m, inverse, absolute(s.p)) + shift(m, inverse)) * DoubleError
    s.pError = stretched(m, at, error) + absolute(s.p) * gamma(2) + shift(m, at) * DoubleError
    s.geometricNormal = normal(m, at, s.geometricNormal).normalized
    val across = normal(m, at, s.frame.n)
    val n = across.normalized.facing(s.geometricNormal)
    s.frame.set(Frame.along(n, vector(m, at, s.frame.s)))
    if s.hasPartials then partials(m, at, across, n, s)

  /** @param across transformed shading normal, not normalised; `n` is the final one */
  private def partials(m: Array[Double], at: Int, across: Vec3, n: Vec3, s: ShadingPoint): Unit =
    val side = if (across dot n) < 0f then -1f else 1f
    val (tangentU, tangentV) = (vector(m, at, s.tangentU), vector(m, at, s.tangentV))
    val (bendU, bendV) = (normal(m, at, s.bendU), normal(m, at, s.bendV))
    val bumpSide = s.bumpSide
    val placesTangents = s.placesTangents
    s.setPartials(
      vector(m, at, s.dpdu),
      vector(m, at, s.dpdv),
      ShadingPoint.turn(across, normal(m, at, s.dndu)) * side,
      ShadingPoint.turn(across, normal(m, at, s.dndv)) * side
    )
    if placesTangents then
      val along = Frame.along(n, s.dpdu)
      s.tangentU = -along.s
      s.tangentV = -along.t
    else
      s.tangentU = tangentU
      s.tangentV = tangentV
    s.bendU = bendU
    s.bendV = bendV
    s.placesTangents = placesTangents
    s.bumpSide = bumpSide

  private def absolute(v: Vec3): Vec3 = Vec3(Math.abs(v.x), Math.abs(v.y), Math.abs(v.z))

  /** A point by the map at `at`. */
  private[accel] def point(m: Array[Double], at: Int, p: Vec3): Vec3 = Vec3(
    (m(at) * p.x + m(at + 1) * p.y + m(at + 2) * p.z + m(at + 3)).toFloat,
    (m(at + 4) * p.x + m(at + 5) * p.y + m(at + 6) * p.z + m(at + 7)).toFloat,
    (m(at + 8) * p.x + m(at + 9) * p.y + m(at + 10) * p.z + m(at + 11)).toFloat
  )

  private def vector(m: Array[Double], at: Int, v: Vec3): Vec3 = Vec3(
    (m(at) * v.x + m(at + 1) * v.y + m(at + 2) * v.z).toFloat,
    (m(at + 4) * v.x + m(at + 5) * v.y + m(at + 6) * v.z).toFloat,
    (m(at + 8) * v.x + m(at + 9) * v.y + m(at + 10) * v.z).toFloat
  )

  /** Transforms by the inverse transpose; not normalised. */
  private def normal(m: Array[Double], at: Int, n: Vec3): Vec3 =
    val i = at + Inverse
    Vec3(
      (m(i) * n.x + m(i + 4) * n.y + m(i + 8) * n.z).toFloat,
      (m(i + 1) * n.x + m(i + 5) * n.y + m(i + 9) * n.z).toFloat,
      (m(i + 2) * n.x + m(i + 6) * n.y + m(i + 10) * n.z).toFloat
    )

  /** Magnitude of the map's translation, per axis. */
  private def shift(m: Array[Double], at: Int): Vec3 =
    absolute(Vec3(m(at + 3).toFloat, m(at + 7).toFloat, m(at + 11).toFloat))

  /** A few Double rounding errors. */
  private inline val DoubleError = 4e-15f

  /** Half extent of the transformed box with half extent `e` around the origin. */
  private def stretched(m: Array[Double], at: Int, e: Vec3): Vec3 =
    def row(r: Int) = (
      Math.abs(m(r)) * e.x + Math.abs(m(r + 1)) * e.y + Math.abs(m(r + 2)) * e.z
    ).toFloat
    Vec3(row(at), row(at + 4), row(at + 8))
