package candela.math

import candela.base.loop

/** An affine or projective map with its inverse.
  *
  * @param m       16 numbers in row order, applied to column vectors; Double, so that long chains
  *   of scene statements lose no precision visible in Float coordinates
  * @param inverse the same for the inverse map
  */
final class Transform private (val m: IArray[Double], val inverseM: IArray[Double]):

  def inverse: Transform = Transform(inverseM, m)

  /** Applies `b`, then this: `(this * b).point(p) == this.point(b.point(p))`. */
  def *(b: Transform): Transform =
    Transform(Transform.product(m, b.m), Transform.product(b.inverseM, inverseM))

  def point(p: Vec3): Vec3 =
    val x = p.x.toDouble
    val y = p.y.toDouble
    val z = p.z.toDouble
    val w = m(12) * x + m(13) * y + m(14) * z + m(15)
    Vec3(
      ((m(0) * x + m(1) * y + m(2) * z + m(3)) / w).toFloat,
      ((m(4) * x + m(5) * y + m(6) * z + m(7)) / w).toFloat,
      ((m(8) * x + m(9) * y + m(10) * z + m(11)) / w).toFloat
    )

  /** As above, in Double. */
  def position(p: Position): Position =
    val w = m(12) * p.x + m(13) * p.y + m(14) * p.z + m(15)
    Position(
      (m(0) * p.x + m(1) * p.y + m(2) * p.z + m(3)) / w,
      (m(4) * p.x + m(5) * p.y + m(6) * p.z + m(7)) / w,
      (m(8) * p.x + m(9) * p.y + m(10) * p.z + m(11)) / w
    )

  def vector(v: Vec3): Vec3 =
    val x = v.x.toDouble
    val y = v.y.toDouble
    val z = v.z.toDouble
    Vec3(
      (m(0) * x + m(1) * y + m(2) * z).toFloat,
      (m(4) * x + m(5) * y + m(6) * z).toFloat,
      (m(8) * x + m(9) * y + m(10) * z).toFloat
    )

  /** Transforms a surface normal by the inverse transpose; not normalised. */
  def normal(n: Vec3): Vec3 =
    val x = n.x.toDouble
    val y = n.y.toDouble
    val z = n.z.toDouble
    Vec3(
      (inverseM(0) * x + inverseM(4) * y + inverseM(8) * z).toFloat,
      (inverseM(1) * x + inverseM(5) * y + inverseM(9) * z).toFloat,
      (inverseM(2) * x + inverseM(6) * y + inverseM(10) * z).toFloat
    )

  /** Whether the map swaps handedness (negative determinant of the linear part). */
  def swapsHandedness: Boolean = determinant < 0

  /** Scale factor, if the linear part is a uniform scale and a rotation. */
  def uniformScale: Option[Double] =
    inline def dot(a: Int, b: Int) = m(a) * m(b) + m(4 + a) * m(4 + b) + m(8 + a) * m(8 + b)
    val s2 = dot(0, 0)
    // Tolerance for rotations given in Float
    inline def isNear(x: Double) = Math.abs(x) <= 1e-5 * s2
    val alike = isNear(dot(0, 0) - s2) && isNear(dot(1, 1) - s2) && isNear(dot(2, 2) - s2)
    val square = isNear(dot(0, 1)) && isNear(dot(0, 2)) && isNear(dot(1, 2))
    Option.when(alike && square)(Math.sqrt(s2))

  /** Determinant of the linear part: the scale of volumes, negative if the map swaps handedness.
    */
  def determinant: Double =
    m(0) * (m(5) * m(10) - m(6) * m(9)) - m(1) * (m(4) * m(10) - m(6) * m(8)) +
      m(2) * (m(4) * m(9) - m(5) * m(8))

  /** Whether the map is affine (last row 0 0 0 1). */
  def isAffine: Boolean = m(12) == 0 && m(13) == 0 && m(14) == 0 && m(15) == 1

  /** Whether the map is singular. The numbers of the inverse are then NaN. */
  def isFlat: Boolean = inverseM(0).isNaN

  def isIdentity: Boolean = this == Transform.Identity

  override def equals(other: Any): Boolean = other match
    case t: Transform =>
      var i = 0
      while i < 16 && m(i) == t.m(i) do i += 1
      i == 16
    case _ => false
  override def hashCode: Int = m.toSeq.hashCode
  override def toString: String = m.mkString("[", " ", "]")

object Transform:

  val Identity: Transform =
    val m = IArray.tabulate(16)(i => if i % 5 == 0 then 1.0 else 0.0)
    new Transform(m, m)

  private def apply(m: IArray[Double], inverse: IArray[Double]): Transform =
    new Transform(m, inverse)

  /** The map with the given 16 numbers, in row order; None if it is singular. */
  def fromRows(rows: IndexedSeq[Double]): Option[Transform] =
    val m = IArray.from(rows)
    invert(m).map(inverse => Transform(m, inverse))

  /** As above, in column order, as in the statements `Transform` and `ConcatTransform`. */
  def fromColumns(columns: IndexedSeq[Double]): Option[Transform] =
    fromRows(Vector.tabulate(16)(i => columns(i % 4 * 4 + i / 4)))

  /** The singular map with the given 16 numbers, in row order; see [[isFlat]]. */
  def flat(rows: IndexedSeq[Double]): Transform =
    Transform(IArray.from(rows), IArray.fill(16)(Double.NaN))

  /** The affine map of which 24 numbers are given from `at` on, as a [[Motion]] writes them. */
  def affine(numbers: Array[Double], at: Int): Transform =
    def rows(from: Int) =
      val matrix = new Array[Double](16)
      System.arraycopy(numbers, from, matrix, 0, 12)
      matrix(15) = 1
      IArray.unsafeFromArray(matrix)
    Transform(rows(at), rows(at + 12))

  /** Maps everything to one point: nothing that it places is visible. */
  val nowhere: Transform = flat(Vector.fill(15)(0.0) :+ 1.0)

  def translate(x: Double, y: Double, z: Double): Transform =
    Transform(
      IArray[Double](1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1),
      IArray[Double](1, 0, 0, -x, 0, 1, 0, -y, 0, 0, 1, -z, 0, 0, 0, 1)
    )

  /** None if a factor is zero, or so small or large that the inverse overflows. */
  def scale(x: Double, y: Double, z: Double): Option[Transform] =
    def isUsable(s: Double) = java.lang.Double.isFinite(1 / s) && java.lang.Double.isFinite(s)
    Option.when(isUsable(x) && isUsable(y) && isUsable(z))(
      Transform(
        IArray[Double](x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, 0, 0, 0, 1),
        IArray[Double](1 / x, 0, 0, 0, 0, 1 / y, 0, 0, 0, 0, 1 / z, 0, 0, 0, 0, 1)
      )
    )

  /** Counter-clockwise rotation about a non-zero axis (Rodrigues' formula). */
  def rotate(degrees: Double, x: Double, y: Double, z: Double): Option[Transform] =
    val length = Math.sqrt(x * x + y * y + z * z)
    Option.when(length > 0):
      val ax = x / length
      val ay = y / length
      val az = z / length
      val s = Math.sin(Math.toRadians(degrees))
      val c = Math.cos(Math.toRadians(degrees))
      val k = 1 - c
      val m = IArray[Double](
        ax * ax * k + c,
        ax * ay * k - az * s,
        ax * az * k + ay * s,
        0, //
        ax * ay * k + az * s,
        ay * ay * k + c,
        ay * az * k - ax * s,
        0, //
        ax * az * k - ay * s,
        ay * az * k + ax * s,
        az * az * k + c,
        0, //
        0,
        0,
        0,
        1
      )
      Transform(m, transposed(m))

  /** World to camera, for a camera at `eye` that looks at `look`; left-handed, y up, z forward, as
    * in PBRT. None if the three don't span a frame.
    */
  def lookAt(eye: Seq[Double], look: Seq[Double], up: Seq[Double]): Option[Transform] =
    def sub(a: Seq[Double], b: Seq[Double]) = a.lazyZip(b).map(_ - _)
    def cross(a: Seq[Double], b: Seq[Double]) =
      Seq(a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0))
    def unit(a: Seq[Double]) =
      val l = Math.sqrt(a.map(x => x * x).sum)
      Option.when(l > 0)(a.map(_ / l))
    for
      z <- unit(sub(look, eye))
      u <- unit(up)
      across = cross(u, z)
      // Rounding of parallel unit vectors leaves some 1e-16
      if across.exists(Math.abs(_) > 1e-13)
      x <- unit(across)
      y = cross(z, x)
      cameraToWorld <- fromRows(
        Vector(0, 1, 2).flatMap(i => Vector(x(i), y(i), z(i), eye(i))) ++ Vector(0.0, 0.0, 0.0, 1.0)
      )
    yield cameraToWorld.inverse

  // Loops over plain arrays: scenes have millions of transforms

  private def transposed(m: IArray[Double]): IArray[Double] =
    val matrix = new Array[Double](16)
    loop(16)(i => matrix(i) = m(i % 4 * 4 + i / 4))
    IArray.unsafeFromArray(matrix)

  private def product(a: IArray[Double], b: IArray[Double]): IArray[Double] =
    val matrix = new Array[Double](16)
    loop(16): i =>
      val r = i & ~3
      val c = i & 3
      matrix(i) = a(r) * b(c) + a(r + 1) * b(c + 4) + a(r + 2) * b(c + 8) + a(r + 3) * b(c + 12)
    IArray.unsafeFromArray(matrix)

  /** Gauss–Jordan elimination with row pivoting. Tracks a bound of each number's rounding error,
    * including the input's: a pivot within its bound may as well be zero, and the matrix is then
    * singular.
    *
    * Source: Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed., §3.3 (running error
    * analysis).
    */
  private def invert(rows: IArray[Double]): Option[IArray[Double]] =
    val a = Array.tabulate(4, 8): (r, c) =>
      if c < 4 then rows(r * 4 + c) else if c - 4 == r then 1.0 else 0.0
    val unit = 4 * Math.ulp(1.0)
    val error = Array.tabulate(4, 4)((r, c) => unit * Math.abs(rows(r * 4 + c)))
    var regular = rows.forall(java.lang.Double.isFinite)
    var column = 0
    while regular && column < 4 do
      val pivot = (column until 4).maxBy(r => Math.abs(a(r)(column)))
      if !(Math.abs(a(pivot)(column)) > error(pivot)(column)) then regular = false
      else
        val row = a(pivot)
        a(pivot) = a(column)
        a(column) = row
        val rowError = error(pivot)
        error(pivot) = error(column)
        error(column) = rowError
        val scale = 1 / row(column)
        for c <- 0 until 8 do row(c) *= scale
        for c <- 0 until 4 do rowError(c) = rowError(c) * Math.abs(scale) + unit * Math.abs(row(c))
        for r <- 0 until 4 if r != column do
          val factor = a(r)(column)
          val factorError = error(r)(column) + unit * Math.abs(factor)
          for c <- 0 until 8 do a(r)(c) -= factor * row(c)
          for c <- 0 until 4 do
            error(r)(c) += factorError * Math.abs(row(c)) + Math.abs(factor) * rowError(c)
        column += 1
    Option.when(regular && a.forall(_.forall(java.lang.Double.isFinite)))(
      IArray.tabulate(16)(i => a(i / 4)(4 + i % 4))
    )
