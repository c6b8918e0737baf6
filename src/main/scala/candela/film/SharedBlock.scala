package candela.film

import candela.base.loop

/** What the samples of one tile add to the pixels x0 ≤ x < x1, y0 ≤ y < y1: those of the tile and
  * those around it that the filter reaches from there. It belongs to one worker at a time.
  */
final class SharedBlock private[film] (
    x0: Int,
    y0: Int,
    x1: Int,
    y1: Int,
    reach: FilterReach
):
  private val width = x1 - x0
  private val height = y1 - y0

  // For each pixel, row by row: weighted red, green, blue, sum of weights
  private val sums = new Array[Double](Math.multiplyExact(4, Math.multiplyExact(width, height)))

  // The pixels that a sample at (x, y) counts in, in pixels of the film
  private def left(x: Float): Int = Math.max(x0, Math.ceil(x - 0.5 - reach.radiusX).toInt)
  private def right(x: Float): Int = Math.min(x1 - 1, Math.floor(x - 0.5 + reach.radiusX).toInt)
  private def top(y: Float): Int = Math.max(y0, Math.ceil(y - 0.5 - reach.radiusY).toInt)
  private def bottom(y: Float): Int = Math.min(y1 - 1, Math.floor(y - 0.5 + reach.radiusY).toInt)

  /** Does a sample at (`x`, `y`) count at all? */
  def reaches(x: Float, y: Float): Boolean = left(x) <= right(x) && top(y) <= bottom(y)

  /** Adds a finite sample at (`x`, `y`) to all pixels that it counts in. */
  def add(x: Float, y: Float, r: Float, g: Float, b: Float): Unit =
    val first = left(x)
    val last = right(x)
    val end = bottom(y)
    var py = top(y)
    while py <= end do
      val inRow = reach.y(y - 0.5f - py)
      var px = first
      var at = 4 * ((py - y0) * width + first - x0)
      while px <= last do
        val weight = (inRow * reach.x(x - 0.5f - px)).toDouble
        sums(at) += weight * r
        sums(at + 1) += weight * g
        sums(at + 2) += weight * b
        sums(at + 3) += weight
        px += 1
        at += 4
      py += 1

  /** Adds all sums to those of a film that begins at (`filmX`, `filmY`). */
  private[film] def addTo(film: Array[Double], filmX: Int, filmY: Int, filmWidth: Int): Unit =
    loop(height): y =>
      val to = 4 * ((y + y0 - filmY) * filmWidth + x0 - filmX)
      val from = 4 * y * width
      loop(4 * width)(i => film(to + i) += sums(from + i))

  private[film] def copy(): SharedBlock =
    val block = SharedBlock(x0, y0, x1, y1, reach)
    System.arraycopy(sums, 0, block.sums, 0, sums.length)
    block

  private[film] def since(earlier: SharedBlock): SharedBlock =
    val block = copy()
    loop(sums.length)(i => block.sums(i) -= earlier.sums(i))
    block
