package candela.color

/** A 3×3 matrix in row order, for colour transforms at scene construction. Immutable. */
final class Matrix3(rows: Vector[Double]):
  require(rows.size == 9, s"${rows.size} numbers")

  def apply(row: Int, column: Int): Double = rows(3 * row + column)

  def *(m: Matrix3): Matrix3 =
    Matrix3.tabulate((r, c) => (0 until 3).map(i => this(r, i) * m(i, c)).sum)

  def *(v: Vector[Double]): Vector[Double] =
    def row(r: Int) = this(r, 0) * v(0) + this(r, 1) * v(1) + this(r, 2) * v(2)
    Vector(row(0), row(1), row(2))

  def *(c: Rgb): Rgb =
    val v = this * Vector(c.r.toDouble, c.g.toDouble, c.b.toDouble)
    Rgb(v(0).toFloat, v(1).toFloat, v(2).toFloat)

  def transposed: Matrix3 = Matrix3.tabulate((r, c) => this(c, r))

  /** Cramer's rule, for well-conditioned matrices. */
  def inverse: Matrix3 =
    def minor(r: Int, c: Int): Double =
      val (r1, r2) = ((r + 1) % 3, (r + 2) % 3)
      val (c1, c2) = ((c + 1) % 3, (c + 2) % 3)
      this(r1, c1) * this(r2, c2) - this(r1, c2) * this(r2, c1)
    val determinant = (0 until 3).map(c => this(0, c) * minor(0, c)).sum
    Matrix3.tabulate((r, c) => minor(c, r) / determinant)

  /** In row order. */
  def toFloats: Array[Float] = rows.map(_.toFloat).toArray

object Matrix3:
  def tabulate(f: (Int, Int) => Double): Matrix3 =
    Matrix3(Vector.tabulate(9)(i => f(i / 3, i % 3)))
