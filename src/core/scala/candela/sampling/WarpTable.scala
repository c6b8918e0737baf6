package candela.sampling

import candela.math.*

/** Tabulated functions on the unit square that depend on two parameters, interpolated bilinearly in
  * position and linearly in each parameter; with the map that importance-samples them, and its
  * inverse.
  *
  * If the table holds densities, each function is normalised to integrate to 1 before
  * interpolation.
  *
  * @param data     values, x fastest, then y, the second parameter and the first
  * @param first    values of the first parameter, ascending; parameters outside are clamped
  * @param second   values of the second parameter, as above
  * @param channels number of functions on the same grid, stored consecutively at each pair of
  *   parameters
  * @param isDensity whether the table is to be sampled; requires a single channel
  *
  * Source: Dupuy and Jakob, "An Adaptive Parameterization for Efficient Material Acquisition and
  * Rendering", SIGGRAPH Asia 2018, §4.
  */
final class WarpTable(
    width: Int,
    height: Int,
    data: Array[Float],
    first: Array[Float],
    second: Array[Float],
    channels: Int = 1,
    isDensity: Boolean = false
):
  private val size = width * height
  private val slices = first.length * second.length
  require(width > 1 && height > 1 && data.length == size * slices * channels)
  require(channels == 1 || !isDensity)

  // The values; prefix sums along each row, and of rows
  private val values = data.clone
  private val along = if isDensity then new Array[Float](size * slices) else Array.emptyFloatArray
  private val down =
    if isDensity then new Array[Float](height * slices) else Array.emptyFloatArray

  if isDensity then for slice <- 0 until slices do integrate(slice)

  private def integrate(slice: Int): Unit =
    val total = new Array[Double](height)
    for y <- 0 until height do
      var sum = 0.0
      val row = slice * size + y * width
      for x <- 1 until width do
        sum += 0.5 * (data(row + x - 1).toDouble + data(row + x))
        along(row + x) = sum.toFloat
      total(y) = sum
    var sum = 0.0
    for y <- 1 until height do
      sum += 0.5 * (total(y - 1) + total(y))
      down(slice * height + y) = sum.toFloat
    val scale = if sum > 0.0 then 1.0 / sum else 0.0
    for i <- slice * size until (slice + 1) * size do
      values(i) = (values(i) * scale * (width - 1) * (height - 1)).toFloat
      along(i) = (along(i) * scale).toFloat
    for i <- slice * height until (slice + 1) * height do down(i) = (down(i) * scale).toFloat

  /** Interpolation weights for a pair of parameters, with room for results; one per query. */
  final class Blend(a: Float, b: Float):
    var x, y = 0f

    // The four tables around the parameters, and their weights
    private val i = WarpTable.cell(first, a)
    private val j = WarpTable.cell(second, b)
    private val s = WarpTable.fraction(first, i, a)
    private val t = WarpTable.fraction(second, j, b)
    private val i1 = Math.min(i + 1, first.length - 1)
    private val j1 = Math.min(j + 1, second.length - 1)
    private val s00 = i * second.length + j
    private val s01 = i * second.length + j1
    private val s10 = i1 * second.length + j
    private val s11 = i1 * second.length + j1
    private val w00 = (1f - s) * (1f - t)
    private val w01 = (1f - s) * t
    private val w10 = s * (1f - t)
    private val w11 = s * t

    private def blended(of: Array[Float], stride: Int, at: Int): Float =
      w00 * of(s00 * stride + at) + w01 * of(s01 * stride + at) +
        w10 * of(s10 * stride + at) + w11 * of(s11 * stride + at)

    private def value(channel: Int, index: Int): Float =
      blended(values, size * channels, channel * size + index)

    /** The function, or pdf, at a point of the square. */
    def apply(px: Float, py: Float, channel: Int = 0): Float =
      val gx = px * (width - 1).toFloat
      val gy = py * (height - 1).toFloat
      val cx = clamp(gx.toInt, 0, width - 2)
      val cy = clamp(gy.toInt, 0, height - 2)
      val fx = gx - cx.toFloat
      val fy = gy - cy.toFloat
      val index = cx + cy * width
      lerp(
        fy,
        lerp(fx, value(channel, index), value(channel, index + 1)),
        lerp(fx, value(channel, index + width), value(channel, index + width + 1))
      )

    private def rowSum(row: Int): Float = blended(along, size, row * width + width - 1)

    /** Sum left of a column, `fy` rows below `row`, and the value there. */
    private def sum(column: Int, row: Int, fy: Float): Float =
      lerp(
        fy,
        blended(along, size, row * width + column),
        blended(along, size, (row + 1) * width + column)
      )

    private def edge(column: Int, row: Int, fy: Float): Float =
      val scale = 1f / ((width - 1).toFloat * (height - 1).toFloat)
      scale * lerp(fy, value(0, row * width + column), value(0, (row + 1) * width + column))

    /** Sets x and y to the image of a uniform point. */
    def sample(u1: Float, u2: Float): Unit =
      val row = WarpTable.findInterval(height)(r => blended(down, height, r) < u2)
      val r0 = rowSum(row)
      val r1 = rowSum(row + 1)
      val fy = WarpTable.invert(r0, r1, u2 - blended(down, height, row))
      val target = u1 * lerp(fy, r0, r1)
      val column = WarpTable.findInterval(width)(c => sum(c, row, fy) < target)
      val fx = WarpTable.invert(
        edge(column, row, fy),
        edge(column + 1, row, fy),
        target - sum(column, row, fy)
      )
      x = (column.toFloat + fx) / (width - 1).toFloat
      y = (row.toFloat + fy) / (height - 1).toFloat

    /** Sets x and y to the uniform point whose image is this point. */
    def invert(px: Float, py: Float): Unit =
      val gx = px * (width - 1).toFloat
      val gy = py * (height - 1).toFloat
      val column = clamp(gx.toInt, 0, width - 2)
      val row = clamp(gy.toInt, 0, height - 2)
      val fx = gx - column.toFloat
      val fy = gy - row.toFloat
      val c0 = edge(column, row, fy)
      val c1 = edge(column + 1, row, fy)
      val preceding = sum(column, row, fy)
      val r0 = rowSum(row)
      val r1 = rowSum(row + 1)
      val rowTotal = lerp(fy, r0, r1)
      x = if rowTotal > 0f then (preceding + fx * (c0 + 0.5f * fx * (c1 - c0))) / rowTotal else fx
      y = blended(down, height, row) + fy * (r0 + 0.5f * fy * (r1 - r0))

object WarpTable:

  /** The last index below `count` − 1 for which `isBelow` holds; 0 if there is none. */
  private inline def findInterval(count: Int)(inline isBelow: Int => Boolean): Int =
    var low = 0
    var high = count - 1
    while high - low > 1 do
      val middle = (low + high) >>> 1
      if isBelow(middle) then low = middle else high = middle
    low

  private def cell(of: Array[Float], v: Float): Int =
    if of.length < 2 then 0 else findInterval(of.length)(of(_) <= v)

  private def fraction(of: Array[Float], i: Int, v: Float): Float =
    if of.length < 2 then 0f else clamp((v - of(i)) / (of(i + 1) - of(i)), 0f, 1f)

  /** Position in [0, 1] at which the integral of a line from `a` at 0 to `b` at 1 reaches `area`.
    */
  private def invert(a: Float, b: Float, area: Float): Float =
    val root =
      if Math.abs(a - b) < 1e-4f * (a + b) then 2f * area / (a + b)
      else (a - safeSqrt(a * a - 2f * area * (a - b))) / (a - b)
    if root >= 0f && root <= 1f then root else if root > 1f then 1f else 0f
