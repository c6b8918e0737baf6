package candela.film

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
