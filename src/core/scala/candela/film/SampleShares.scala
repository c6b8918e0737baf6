package candela.film

import candela.io.{CheckedInput, CheckedOutput}
import java.util.Arrays

/** Accumulates samples that contribute to all pixels within the filter's radius, by filter weight:
  * the pixel value is the weighted average.
  *
  * The expected image is that of [[FilterSampler]], where a sample contributes to one pixel only,
  * but with less noise: Σw² / (Σw)² falls by ∫f² / (∫f)² of the filter f along each axis, so that
  * the variance is 4/9 for a triangle of radius 1, and less for wider filters. In turn the noise of
  * neighbouring pixels is correlated.
  *
  * Each tile accumulates into its own block: one sample of all its pixels is accumulated in
  * Doubles, and these sums are added up exactly. Blocks are merged in order. So the image is
  * bit-identical for any thread count, and however the samples are divided.
  *
  * Source: Pharr, Jakob, Humphreys, "Physically Based Rendering", 3rd ed. 2016, §7.9.2, eq. 7.12.
  */
final class SampleShares private (
    bounds: PixelBounds,
    private val blocks: Vector[SharedBlock]
):
  /** Adds samples; one for each worker.
    *
    * @param levels receives them, too
    */
  def pass(levels: Option[LevelPass] = None): SharedPass = SharedPass(blocks, levels.orNull)

  /** Pixels that the samples of each tile contribute to. */
  def reached: Vector[PixelBounds] = blocks.map(_.bounds)

  /** Sets `row` to what the pixels of the film's row `y` hold: for each one weighted red, green,
    * blue, sum of weights.
    */
  def read(y: Int, row: Array[Double]): Unit =
    Arrays.fill(row, 0.0)
    val index = Arrays.binarySearch(cuts, y)
    val strip = if index >= 0 then index else -index - 2
    if strip >= 0 && strip < strips.length then strips(strip).foreach(_.addTo(row, y, bounds.x0))

  /** Rows at which blocks begin or end. Between two of them are the rows of a strip. */
  private lazy val cuts: Array[Int] =
    blocks.flatMap(b => Vector(b.bounds.y0, b.bounds.y1)).distinct.sorted.toArray

  /** The blocks of each strip, in order: a film has a hundred thousand, a row a few hundred. */
  private lazy val strips: Array[Array[SharedBlock]] =
    val inStrip = Array.fill(cuts.length - 1)(Array.newBuilder[SharedBlock])
    for b <- blocks do
      for s <- Arrays.binarySearch(cuts, b.bounds.y0) until Arrays.binarySearch(cuts, b.bounds.y1)
      do
        inStrip(s) += b
    inStrip.map(_.result())

  def copy(): SampleShares = new SampleShares(bounds, blocks.map(_.copy()))

  /** The delta since `earlier` was copied. */
  def deltaSince(earlier: SampleShares): SampleShares =
    val added = blocks.zip(earlier.blocks).map((now, before) => now.deltaSince(before))
    new SampleShares(bounds, added)

  /** How many sums a tile has. */
  def size(tile: Int): Int = blocks(tile).sums.size

  def save(to: CheckedOutput): Unit = blocks.foreach(_.sums.save(to))

  /** Adds what was saved. */
  def load(from: CheckedInput): Unit = blocks.foreach(_.sums.load(from))

object SampleShares:
  /** Covers these pixels of the film.
    *
    * @param tiles of all samples that contribute to these pixels; each has its own block
    */
  def apply(
      bounds: PixelBounds,
      reach: FilterReach,
      tiles: Vector[PixelBounds]
  ): SampleShares =
    val blocks = tiles.map: t =>
      SharedBlock(t.widened(reach.beyondX, reach.beyondY).intersection(bounds), reach)
    new SampleShares(bounds, blocks)

/** Accumulators of one tile for the pixels of `bounds`: those of the tile and those
  * within the filter's radius around it. One worker at a time owns it.
  */
private final class SharedBlock(
    val bounds: PixelBounds,
    val reach: FilterReach
):
  val x0: Int = bounds.x0
  val y0: Int = bounds.y0
  private val x1 = bounds.x1
  private val y1 = bounds.y1
  val width: Int = bounds.width

  // For each pixel, row by row: weighted red, green, blue, sum of weights
  val sums = ExactSums(Math.multiplyExact(4, Math.multiplyExact(width, bounds.height)))

  // Pixel range that a sample at (x, y) contributes to, in film pixels
  def left(x: Float): Int = Math.max(x0, Math.ceil(x - 0.5 - reach.radiusX).toInt)
  def right(x: Float): Int = Math.min(x1 - 1, Math.floor(x - 0.5 + reach.radiusX).toInt)
  def top(y: Float): Int = Math.max(y0, Math.ceil(y - 0.5 - reach.radiusY).toInt)
  def bottom(y: Float): Int = Math.min(y1 - 1, Math.floor(y - 0.5 + reach.radiusY).toInt)

  /** Adds row `y` of the block to a row of a film that begins at `filmX`. */
  def addTo(row: Array[Double], y: Int, filmX: Int): Unit =
    sums.addTo(row, 4 * (x0 - filmX), 4 * (y - y0) * width, 4 * width)

  def copy(): SharedBlock =
    val block = SharedBlock(bounds, reach)
    block.sums.add(sums)
    block

  def deltaSince(earlier: SharedBlock): SharedBlock =
    val block = copy()
    block.sums.add(earlier.sums, isNegative = true)
    block

/** Adds samples to the blocks of [[SampleShares]]: one sample of each pixel of a tile at a time.
  * Mutable, one per worker.
  */
final class SharedPass private[film] (blocks: Vector[SharedBlock], levels: LevelPass | Null):
  private var block = blocks.head
  private var sampleWeight = 1f
  private val sums = new Array[Double](blocks.map(_.sums.size).max)

  // Weights of the columns that a sample contributes to
  private val columns = new Array[Float](2 * blocks.map(_.reach.beyondX).max + 2)

  /** Selects the tile, and what its samples count. */
  def selectTile(tile: Int, sampleWeight: Float = 1f): Unit =
    block = blocks(tile)
    this.sampleWeight = sampleWeight

  /** Whether a sample at (`x`, `y`) contributes to any pixel. */
  def reaches(x: Float, y: Float): Boolean =
    block.left(x) <= block.right(x) && block.top(y) <= block.bottom(y)

  /** Adds a finite sample at (`x`, `y`) to all pixels that it contributes to. */
  def add(x: Float, y: Float, r: Float, g: Float, b: Float): Unit =
    val reach = block.reach
    val first = block.left(x)
    val last = block.right(x)
    val end = block.bottom(y)
    var column = first
    while column <= last do
      columns(column - first) = reach.x(x - 0.5f - column)
      column += 1
    var py = block.top(y)
    while py <= end do
      val inRow = sampleWeight * reach.y(y - 0.5f - py)
      var px = first
      var offset = 4 * ((py - block.y0) * block.width + first - block.x0)
      while px <= last do
        val weight = (inRow * columns(px - first)).toDouble
        sums(offset) += weight * r
        sums(offset + 1) += weight * g
        sums(offset + 2) += weight * b
        sums(offset + 3) += weight
        if levels != null then levels.add(offset / 4, weight)
        px += 1
        offset += 4
      py += 1

  /** Gives up a sample of the tile's pixels in its midst; `resume` goes on with it. */
  def suspend(): Array[Double] = Arrays.copyOf(sums, block.sums.size)

  def resume(suspended: Array[Double]): Unit =
    System.arraycopy(suspended, 0, sums, 0, suspended.length)

  /** Ends a sample of the tile's pixels. */
  def end(): Unit =
    val to = block.sums
    var i = 0
    while i < to.size do
      if sums(i) != 0.0 then
        to.add(i, sums(i))
        sums(i) = 0.0
      i += 1

/** Extent and tabulated weights of a filter along both axes. Immutable. */
final class FilterReach(filter: Filter):
  val radiusX: Float = filter.radiusX
  val radiusY: Float = filter.radiusY
  val x: FilterTable = FilterTable(radiusX, filter.x)
  val y: FilterTable = FilterTable(radiusY, filter.y)

  /** Pixels on either side of its own that a sample may contribute to. */
  val beyondX: Int = FilterReach.beyond(radiusX)
  val beyondY: Int = FilterReach.beyond(radiusY)

object FilterReach:
  private def beyond(radius: Float): Int = Math.ceil(radius - 0.5).toInt

  /** Whether sharing samples pays off. Not if all samples stay in their own pixel, if the filter is
    * so wide that the border of a tile needs more memory than the tile, or if it is so narrow that
    * few samples count.
    */
  def isUseful(filter: Filter): Boolean =
    val extent = Math.max(beyond(filter.radiusX), beyond(filter.radiusY))
    extent >= 1 && extent <= MaxPixels && filter.correlation >= MinArea

  /** Reach of a filter beyond its pixel. */
  private val MaxPixels = 8

  /** Pixels whose samples count as much as those under the filter. */
  private val MinArea = 0.5
