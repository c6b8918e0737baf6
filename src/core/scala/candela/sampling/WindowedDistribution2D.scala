package candela.sampling

import candela.base.loop
import candela.math.*

/** Samples any window of the unit square in proportion to a piecewise-constant function on a
  * regular grid. Immutable.
  *
  * Sums over rectangles come from a summed-area table, bilinearly interpolated.
  *
  * Sources: Crow, "Summed-Area Tables for Texture Mapping", SIGGRAPH 1984; PBRT 4th ed., §A.5.6.
  *
  * @param values values of the function in row order, x along rows
  */
final class WindowedDistribution2D(values: Array[Float], columns: Int, rows: Int):
  require(values.length == Math.multiplyExact(columns, rows))

  /** Sums of all cells left of column x and above row y, (rows + 1) × (columns + 1). */
  private val sums: Array[Double] =
    val s = new Array[Double]((columns + 1) * (rows + 1))
    loop(rows): y =>
      var row = 0.0
      loop(columns): x =>
        row += values(y * columns + x)
        val below = (y + 1) * (columns + 1) + x + 1
        s(below) = s(below - columns - 1) + row
    s

  /** ∫ over [0, x] × [0, y]. */
  private def upTo(x: Double, y: Double): Double =
    val cx = x * columns
    val cy = y * rows
    val i = Math.min(cx.toInt, columns - 1)
    val j = Math.min(cy.toInt, rows - 1)
    val tx = cx - i
    val ty = cy - j
    val index = j * (columns + 1) + i
    val top = sums(index) * (1 - tx) + sums(index + 1) * tx
    val bottom = sums(index + columns + 1) * (1 - tx) + sums(index + columns + 2) * tx
    (top * (1 - ty) + bottom * ty) / (columns.toDouble * rows)

  /** ∫ of the function over the window; its edges in [0, 1]. */
  def integral(x0: Float, y0: Float, x1: Float, y1: Float): Double =
    Math.max(0.0, mass(x0.toDouble, y0.toDouble, x1.toDouble, y1.toDouble))

  private def mass(x0: Double, y0: Double, x1: Double, y1: Double): Double =
    upTo(x1, y1) - upTo(x0, y1) - upTo(x1, y0) + upTo(x0, y0)

  /** (x, y, pdf): the position in the window sampled by (`u1`, `u2`) of the unit square; the pdf is
    * 0 if the function is zero in the window.
    */
  def sample(u1: Float, u2: Float, x0: Float, y0: Float, x1: Float, y1: Float): Vec3 =
    val total = integral(x0, y0, x1, y1)
    if !(total > 0) then Vec3.Zero
    else
      val top = y0.toDouble
      val bottom = y1.toDouble
      val x =
        bisect(u1 * total, x0.toDouble, x1.toDouble, columns)(mass(x0.toDouble, top, _, bottom))
      val column = Math.min((x * columns).toInt, columns - 1).toDouble
      val left = column / columns
      val right = (column + 1) / columns
      val columnMass = mass(left, top, right, bottom)
      if !(columnMass > 0) then Vec3.Zero
      else
        val y = bisect(u2 * columnMass, top, bottom, rows)(mass(left, top, right, _))
        Vec3(x.toFloat, y.toFloat, density(x.toFloat, y.toFloat, total))

  /** Position at which the increasing `sum` reaches `target`: the cell by bisection, then linearly.
    */
  private inline def bisect(target: Double, low: Double, high: Double, cells: Int)(
      inline sum: Double => Double
  ): Double =
    // Indices of cell borders within the window: sum(first) ≤ target < sum(last)
    var first = Math.floor(low * cells).toInt
    var last = Math.ceil(high * cells).toInt
    while last - first > 1 do
      val middle = (first + last) >>> 1
      if sum(middle.toDouble / cells) <= target then first = middle else last = middle
    val a = Math.max(low, first.toDouble / cells)
    val b = Math.min(high, last.toDouble / cells)
    val sumA = sum(a)
    val sumB = sum(b)
    val t = if sumB > sumA then (target - sumA) / (sumB - sumA) else 0.5
    Math.max(a, Math.min(b, a + t * (b - a)))

  /** Pdf of `sample` for the window at a position within it. */
  def pdf(x: Float, y: Float, x0: Float, y0: Float, x1: Float, y1: Float): Float =
    if x < x0 || x > x1 || y < y0 || y > y1 then 0f
    else
      val total = integral(x0, y0, x1, y1)
      if total > 0 then density(x, y, total) else 0f

  private def density(x: Float, y: Float, total: Double): Float =
    val i = Math.min((x * columns).toInt, columns - 1)
    val j = Math.min((y * rows).toInt, rows - 1)
    (values(j * columns + i) / total).toFloat
