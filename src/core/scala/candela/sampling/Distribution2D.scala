package candela.sampling

import candela.base.loop
import candela.io.{CheckedInput, CheckedOutput, PartForm}
import java.io.IOException

import candela.math.*

/** Piecewise-constant distribution over the unit square with a regular grid of cells; uniform if
  * the function is all zero. Immutable. Used to importance-sample environment maps.
  *
  * Source: PBRT 3rd ed., §13.6.7.
  *
  * @param integral   ∫ of the piecewise-constant function over the square
  * @param inRow      CDFs of the rows, each of `columns` + 1 entries
  * @param rowCdf     CDF of the rows
  * @param binsInRow  cutpoints of the CDF of each row
  * @param binsOfRows cutpoints of `rowCdf`
  */
final class Distribution2D private (
    val columns: Int,
    val rows: Int,
    val integral: Double,
    inRow: Array[Float],
    rowCdf: Array[Float],
    binsInRow: Array[Int],
    binsOfRows: Array[Int]
):
  private val cutsInRow = Cdf.cutpoints(columns)
  private val cutsOfRows = Cdf.cutpoints(rows)

  /** (x, y, pdf): the position sampled by (`u1`, `u2`) in the half-open unit square. */
  def sample(u1: Float, u2: Float): Vec3 =
    val row = Cdf.findBin(rowCdf, 0, u2, cutsOfRows, binsOfRows, 0)
    val rowStart = row * (columns + 1)
    val column = Cdf.findBin(inRow, rowStart, u1, cutsInRow, binsInRow, row * (cutsInRow + 1))
    Vec3(
      Cdf.position(column, Cdf.relativePosition(inRow, rowStart, column, u1), columns),
      Cdf.position(row, Cdf.relativePosition(rowCdf, 0, row, u2), rows),
      density(column, row)
    )

  /** Pdf of `sample` at (`x`, `y`); 0 outside the square. */
  def pdf(x: Float, y: Float): Float =
    if x < 0f || x > 1f || y < 0f || y > 1f then 0f
    else density(Cdf.binOf(x, columns), Cdf.binOf(y, rows))

  private def density(column: Int, row: Int): Float =
    val index = row * (columns + 1) + column
    (inRow(index + 1) - inRow(index)) * columns * ((rowCdf(row + 1) - rowCdf(row)) * rows)

  private def arrays = (inRow, rowCdf, binsInRow, binsOfRows)

object Distribution2D:

  /** @param values values of the function in row order, x along rows */
  def apply(values: Array[Float], columns: Int, rows: Int): Distribution2D =
    require(columns > 0 && rows > 0, s"a grid of $columns by $rows has no cells")
    require(
      values.length == Math.multiplyExact(columns, rows),
      s"${values.length} values for $columns by $rows cells"
    )
    val (cutsInRow, cutsOfRows) = (Cdf.cutpoints(columns), Cdf.cutpoints(rows))
    val inRow = new Array[Float](Math.multiplyExact(columns + 1, rows))
    val rowCdf = new Array[Float](rows + 1)
    val binsInRow = new Array[Int](Math.multiplyExact(cutsInRow + 1, rows))
    val binsOfRows = new Array[Int](cutsOfRows + 1)
    val totals = new Array[Double](rows)
    loop(rows)(r => totals(r) = Cdf.write(values, r * columns, columns, inRow, r * (columns + 1)))
    // Row weights need a common scale only; this one can't overflow.
    val largest = totals.max
    val shares = totals.map(t => if largest > 0 then (t / largest).toFloat else 0f)
    loop(rows): r =>
      Cdf.writeCutpoints(
        inRow,
        r * (columns + 1),
        columns,
        cutsInRow,
        binsInRow,
        r * (cutsInRow + 1)
      )
    val sum = Cdf.write(shares, 0, rows, rowCdf, 0)
    Cdf.writeCutpoints(rowCdf, 0, rows, cutsOfRows, binsOfRows, 0)
    val integral = sum * largest / (columns.toDouble * rows)
    new Distribution2D(columns, rows, integral, inRow, rowCdf, binsInRow, binsOfRows)

  /** Of its files. */
  object Form extends PartForm[Distribution2D]("distribution 1"):
    def size(d: Distribution2D): Long =
      val (inRow, _, bins, _) = d.arrays
      4L * (inRow.length.toLong + bins.length)

    def write(d: Distribution2D, out: CheckedOutput): Unit =
      val (inRow, rowCdf, binsInRow, binsOfRows) = d.arrays
      out.int(d.columns)
      out.int(d.rows)
      out.double(d.integral)
      out.floats(inRow)
      out.floats(rowCdf)
      out.ints(binsInRow)
      out.ints(binsOfRows)

    def read(in: CheckedInput): Distribution2D =
      val (columns, rows) = (in.int(), in.int())
      val result = new Distribution2D(
        columns,
        rows,
        in.double(),
        in.floats(),
        in.floats(),
        in.ints(),
        in.ints()
      )
      val (inRow, rowCdf, binsInRow, binsOfRows) = result.arrays
      def matches(length: Int, of: Long) = length == of
      val fits = columns > 0 && rows > 0 && matches(inRow.length, (columns + 1L) * rows) &&
        matches(rowCdf.length, rows + 1L) &&
        matches(binsInRow.length, (Cdf.cutpoints(columns) + 1L) * rows) &&
        matches(binsOfRows.length, Cdf.cutpoints(rows) + 1L)
      if !fits then throw IOException("its parts don't fit together")
      result
