package candela.measure

import candela.base.loop
import candela.image.Image

/** The sums of an image's values over tiles of [[TileSums.Size]] pixels squared, in rows from the
  * top; those at the right and bottom edge may be smaller. A tile with NaN or infinite values has
  * such a sum.
  *
  * @param sums by tile and channel
  * @param isHalf whether all values have the precision of half floats
  */
final class TileSums private (
    val width: Int,
    val height: Int,
    val channels: Vector[String],
    private val sums: Array[Double],
    val isHalf: Boolean
):
  def columns: Int = TileSums.count(width)
  def rows: Int = TileSums.count(height)

  def apply(tile: Int, channel: Int): Double = sums(tile * channels.size + channel)

  def isFinite(tile: Int): Boolean =
    channels.indices.forall(c => java.lang.Double.isFinite(this(tile, c)))

  private[measure] def isSame(other: TileSums): Boolean = sums.sameElements(other.sums)

  /** Other sums in their place.
    *
    * @param change of a tile's column, row and sum
    */
  private[candela] def mapped(change: (Int, Int, Double) => Double): TileSums =
    val count = channels.size
    val changed = Array.tabulate(sums.length): i =>
      val tile = i / count
      change(tile % columns, tile / columns, sums(i))
    TileSums(width, height, channels, changed, isHalf)

object TileSums:
  /** Pixels along the side of a tile. */
  val Size = 8

  def of(image: Image): TileSums =
    val linear = image.linear
    val (channels, across) = (linear.channels, count(linear.width))
    val sums = new Array[Double](across * count(linear.height) * channels)
    var isHalf = true
    loop(linear.height): y =>
      loop(linear.width): x =>
        val tile = y / Size * across + x / Size
        loop(channels): c =>
          val value = linear(x, y, c)
          sums(tile * channels + c) += value
          if isHalf then isHalf = (java.lang.Float.floatToRawIntBits(value) & BeyondHalf) == 0
    TileSums(linear.width, linear.height, linear.channelNames, sums, isHalf)

  /** Digits of a float that a half float lacks. */
  private val BeyondHalf = 0x1fff

  private def count(pixels: Int): Int = (pixels + Size - 1) / Size

/** Sums of rectangles of tiles. */
private[measure] final class PrefixSums(columns: Int, rows: Int, value: Int => Double):
  private val prefix = new Array[Double]((columns + 1) * (rows + 1))
  loop(rows): y =>
    var row = 0.0
    loop(columns): x =>
      row += value(y * columns + x)
      prefix((y + 1) * (columns + 1) + x + 1) = prefix(y * (columns + 1) + x + 1) + row

  def apply(x0: Int, x1: Int, y0: Int, y1: Int): Double =
    def prefixAt(x: Int, y: Int) = prefix(y * (columns + 1) + x)
    prefixAt(x1, y1) - prefixAt(x0, y1) - prefixAt(x1, y0) + prefixAt(x0, y0)
