package candela.sampling

import candela.base.loop
import candela.math.*

/** A density over the unit square that is constant on a grid of equal cells; an all-zero function
  * counts as a uniform one. Immutable. To pick light directions from images.
  *
  * Source: PBRT 3rd ed., §13.6.7.
  *
  * @param values of the function, row by row; x runs along a row, y from row to row
  */
final class Distribution2D(values: Array[Float], val columns: Int, val rows: Int):
  require(columns > 0 && rows > 0, s"a grid of $columns by $rows has no cells")
  require(
    values.length == Math.multiplyExact(columns, rows),
    s"${values.length} values for $columns by $rows cells"
  )

  /** Row after row, each of `columns` + 1 running sums. */
  private val inRow = new Array[Float](Math.multiplyExact(columns + 1, rows))
  private val rowCdf = new Array[Float](rows + 1)

  /** ∫ of the function that the values describe, over the square. */
  val integral: Double =
    val totals = new Array[Double](rows)
    loop(rows)(r => totals(r) = Cdf.write(values, r * columns, columns, inRow, r * (columns + 1)))
    // Floats of any common scale do for the shares of the rows; this one can't overflow.
    val largest = totals.max
    val shares = totals.map(t => if largest > 0 then (t / largest).toFloat else 0f)
    Cdf.write(shares, 0, rows, rowCdf, 0) * largest / (columns.toDouble * rows)

  /** (x, y, density): the place for (`u1`, `u2`) of the unit square, without its upper edges. */
  def sample(u1: Float, u2: Float): Vec3 =
    val row = Cdf.find(rowCdf, 0, rows, u2)
    val at = row * (columns + 1)
    val column = Cdf.find(inRow, at, columns, u1)
    Vec3(
      Cdf.place(column, Cdf.within(inRow, at, column, u1), columns),
      Cdf.place(row, Cdf.within(rowCdf, 0, row, u2), rows),
      density(column, row)
    )

  /** The density of `sample` at (`x`, `y`); 0 outside of the square. */
  def pdf(x: Float, y: Float): Float =
    if x < 0f || x > 1f || y < 0f || y > 1f then 0f
    else density(Cdf.binOf(x, columns), Cdf.binOf(y, rows))

  private def density(column: Int, row: Int): Float =
    val at = row * (columns + 1) + column
    (inRow(at + 1) - inRow(at)) * columns * ((rowCdf(row + 1) - rowCdf(row)) * rows)
