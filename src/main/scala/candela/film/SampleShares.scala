package candela.film

import candela.base.loop

/** Sums of samples each of which counts in all pixels that the filter reaches, by its weight there:
  * the pixel's value is the weighted mean.
  *
  * The expected image is that of [[FilterSampler]], where a sample counts in one pixel alone, but
  * the noise is less: Σw² / (Σw)² falls by ∫f² / (∫f)² of the filter f along each axis, which makes
  * the variance 4/9 for a triangle of radius 1, and less for wider ones. In turn the noise of
  * neighbours is alike.
  *
  * Each tile adds to a block of its own, and the blocks are added up in their order: so the image
  * is the same, bit for bit, however many workers there are.
  *
  * Source: Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd ed. 2016, §7.9.2, eq. 7.12.
  */
final class SampleShares private (
    x0: Int,
    y0: Int,
    x1: Int,
    y1: Int,
    private val blocks: Vector[SharedBlock]
):
  def block(tile: Int): SharedBlock = blocks(tile)

  /** For each pixel, row by row: weighted red, green, blue, sum of weights. */
  def sums: Array[Double] =
    val width = x1 - x0
    val all = new Array[Double](Math.multiplyExact(4, Math.multiplyExact(width, y1 - y0)))
    blocks.foreach(_.addTo(all, x0, y0, width))
    all

  def copy(): SampleShares = new SampleShares(x0, y0, x1, y1, blocks.map(_.copy()))

  /** What was added since `earlier` was copied. */
  def since(earlier: SampleShares): SampleShares =
    val added = blocks.zip(earlier.blocks).map((now, before) => now.since(before))
    new SampleShares(x0, y0, x1, y1, added)

object SampleShares:
  /** For the pixels x0 ≤ x < x1, y0 ≤ y < y1 of the film.
    *
    * @param tiles of all samples that count in one of these pixels; each has a block of its own
    */
  def apply(
      x0: Int,
      y0: Int,
      x1: Int,
      y1: Int,
      reach: FilterReach,
      tiles: Vector[PixelBounds]
  ): SampleShares =
    val blocks = tiles.map: t =>
      SharedBlock(
        Math.max(x0, t.x0 - reach.beyondX),
        Math.max(y0, t.y0 - reach.beyondY),
        Math.min(x1, t.x1 + reach.beyondX),
        Math.min(y1, t.y1 + reach.beyondY),
        reach
      )
    new SampleShares(x0, y0, x1, y1, blocks)

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

/** How far a filter lets a sample count, and how much: tables of its two axes. Immutable. */
final class FilterReach(filter: Filter):
  val radiusX: Float = filter.radiusX
  val radiusY: Float = filter.radiusY
  val x: FilterTable = FilterTable(radiusX, filter.x)
  val y: FilterTable = FilterTable(radiusY, filter.y)

  /** Pixels beyond its own, to either side, in which a sample may count. */
  val beyondX: Int = FilterReach.beyond(radiusX)
  val beyondY: Int = FilterReach.beyond(radiusY)

object FilterReach:
  private def beyond(radius: Float): Int = Math.ceil(radius - 0.5).toInt

  /** Is there any use in sharing samples by this filter? Not if all stay in their own pixel; nor if
    * it is so wide that the pixels around a tile would take more memory than those within.
    */
  def isUseful(filter: Filter): Boolean =
    val most = Math.max(beyond(filter.radiusX), beyond(filter.radiusY))
    most >= 1 && most <= Most

  private val Most = 8
