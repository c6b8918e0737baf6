package candela.sampling

import candela.base.loop
import candela.math.*

/** Running sums as flat Float data: those of a row of n weights are n + 1 numbers from 0 to 1 that
  * never fall. A bin's probability is the difference of its two sums, as stored: what is sampled
  * and what is reported as density is the same to the last bit, whatever the sums lost by rounding.
  */
private[sampling] object Cdf:

  /** Writes the sums of `count` weights; equal shares if all weights are zero.
    *
    * @return the total of the weights
    */
  def write(weights: Array[Float], from: Int, count: Int, cdf: Array[Float], to: Int): Double =
    var total = 0.0
    var i = 0
    while i < count do
      val w = weights(from + i)
      require(w >= 0f && w < Float.PositiveInfinity, s"weight $i is $w")
      total += w
      i += 1
    cdf(to) = 0f
    var sum = 0.0
    i = 0
    while i < count do
      sum += weights(from + i)
      val share = if total > 0 then sum / total else (i + 1.0) / count
      cdf(to + i + 1) = share.toFloat
      i += 1
    cdf(to + count) = 1f
    total

  /** The bin i < `count` whose half-open interval of sums holds `u` in [0, 1). Its probability is
    * above zero.
    */
  def find(cdf: Array[Float], at: Int, count: Int, u: Float): Int =
    // the last i with sum(i) ≤ u: bins of probability zero have their successor's sum, so they lose
    var low = 0
    var high = count
    while high - low > 1 do
      val middle = (low + high) >>> 1
      if cdf(at + middle) <= u then low = middle else high = middle
    low

  /** Where in its bin `u` lies, in [0, 1). */
  def within(cdf: Array[Float], at: Int, bin: Int, u: Float): Float =
    val low = cdf(at + bin)
    Math.min((u - low) / (cdf(at + bin + 1) - low), candela.math.OneMinusEpsilon)

  /** A place in bin `bin` of `count` equal ones over [0, 1), which [[binOf]] finds again. */
  def place(bin: Int, fraction: Float, count: Int): Float =
    var x = Math.min((bin + fraction) / count, candela.math.OneMinusEpsilon)
    while binOf(x, count) > bin do x = Math.nextDown(x)
    while binOf(x, count) < bin do x = Math.nextUp(x)
    x

  def binOf(x: Float, count: Int): Int =
    candela.math.clamp((x * count).toInt, 0, count - 1)

/** Picks one of n things with given weights; all-zero weights count as equal ones. Immutable.
  *
  * The pick grows with the random number, so that a well-distributed sequence of numbers makes a
  * well-distributed sequence of picks (an alias table would shuffle them).
  */
final class Discrete(weights: Array[Float]):
  require(weights.length > 0, "nothing to pick from")

  private val cdf = new Array[Float](weights.length + 1)

  Cdf.write(weights, 0, weights.length, cdf, 0): Unit

  def size: Int = cdf.length - 1

  /** The pick for `u` in [0, 1); never one of probability 0. */
  def sample(u: Float): Int = Cdf.find(cdf, 0, size, u)

  /** What is left of `u` after it picked `picked`: uniform in [0, 1) again, with fewer bits. */
  def remapped(u: Float, picked: Int): Float = Cdf.within(cdf, 0, picked, u)

  /** With which probability `sample` picks `index`. */
  def probability(index: Int): Float = cdf(index + 1) - cdf(index)

/** A density over [0, 1) that is constant on n equal bins; an all-zero function counts as a uniform
  * one. Immutable.
  *
  * Source: PBRT 3rd ed., §13.3.1.
  */
final class Distribution1D(values: Array[Float]):
  require(values.length > 0, "no values")

  private val cdf = new Array[Float](values.length + 1)

  Cdf.write(values, 0, values.length, cdf, 0): Unit

  def size: Int = cdf.length - 1

  /** The place for `u` in [0, 1), itself in [0, 1). */
  def sample(u: Float): Float =
    val bin = Cdf.find(cdf, 0, size, u)
    Cdf.place(bin, Cdf.within(cdf, 0, bin, u), size)

  /** The density of `sample` at `x`; 0 outside of [0, 1]. */
  def pdf(x: Float): Float =
    if x < 0f || x > 1f then 0f
    else
      val bin = Cdf.binOf(x, size)
      (cdf(bin + 1) - cdf(bin)) * size

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
