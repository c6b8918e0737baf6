package candela.render

/** In which order an image is rendered: waves of samples, each over all tiles, row by row.
  *
  * The waves grow (1, 1, 2, 4, … 64 samples per pixel), so that an image which is cut short is
  * noisy evenly, while a long rendering rarely comes back to a tile.
  */
private[render] final class Schedule(
    crop: PixelBounds,
    samplesPerPixel: Int,
    largestWave: Int = Schedule.LargestWave
):
  import Schedule.*

  private val columns = (crop.width + TileSize - 1) / TileSize
  private val rows = (crop.height + TileSize - 1) / TileSize
  val tiles: Int = Math.multiplyExact(columns, rows)

  // Wave w has the samples from waveStarts(w) until waveStarts(w + 1): each doubles what there is.
  private val waveStarts: Array[Int] =
    Iterator
      .iterate(0)(start => start + Math.min(Math.max(start, 1), largestWave))
      .takeWhile(_ < samplesPerPixel)
      .toArray :+ samplesPerPixel

  val waves: Int = waveStarts.length - 1

  /** One tile in one wave is one step; the steps of a wave are consecutive. */
  val steps: Long = waves.toLong * tiles

  def firstSample(wave: Int): Int = waveStarts(wave)

  /** One more than the last sample of the wave. */
  def endSample(wave: Int): Int = waveStarts(wave + 1)

  /** After which waves every pixel has 1, 2, 4, 8, … samples, and after which it has all. */
  def passes: Vector[Int] = (1 to waves).toVector.filter: end =>
    end == waves || Integer.bitCount(waveStarts(end)) == 1

  def tile(index: Int): PixelBounds =
    val x = crop.x0 + index % columns * TileSize
    val y = crop.y0 + index / columns * TileSize
    PixelBounds(x, y, Math.min(x + TileSize, crop.x1), Math.min(y + TileSize, crop.y1))

private[render] object Schedule:

  /** Pixels along a tile's edge: small enough that all workers end at about the same time. */
  val TileSize: Int = 16

  /** Samples per pixel. Longer visits to a tile would not be cheaper. */
  val LargestWave: Int = 64
