package candela.film

import candela.base.loop
import candela.io.{CheckedInput, CheckedOutput}
import java.util.Arrays

/** The light of camera samples by their brightness, for [[FireflyWeights]]: level i is around
  * 8^(i − 8). A sample in between is divided between two levels.
  *
  * Sums are exact, as those of [[Film]], and kept tile by tile, from the first sample of a level
  * on: most tiles show few levels. One worker at a time owns a tile.
  *
  * @param tiles pixels that the samples of each tile contribute to
  */
final class BrightnessLevels(tiles: Vector[PixelBounds]):
  private val blocks = tiles.map(LevelBlock(_))

  def pass(): LevelPass = LevelPass(blocks)

  /** Bytes in use. */
  def memory: Long = blocks.map(_.memory).sum

  /** Sets `to` to the light of a level: red, green and blue of each pixel, row by row.
    *
    * @param film bounds of `to`
    * @return false if there is none
    */
  def read(level: Int, film: PixelBounds, to: Array[Double]): Boolean =
    Arrays.fill(to, 0.0)
    blocks.count(_.addTo(level, film, to)) > 0

  def save(to: CheckedOutput): Unit = blocks.foreach(_.save(to))

  /** Adds what was saved. */
  def load(from: CheckedInput): Unit = blocks.foreach(_.load(from))

object BrightnessLevels:
  /** Number of levels: from 6e-8 to 7e10. */
  val Count: Int = 21

  /** Power of 8 of level 0, which has all darker samples, too; the last has all brighter ones. */
  private[film] inline val FirstExponent = -8

  /** Brightness of a level. */
  def brightness(level: Int): Float = Math.scalb(1f, 3 * (level + FirstExponent))

/** The levels of one tile. */
private final class LevelBlock(bounds: PixelBounds):
  private val sums = new Array[ExactSums | Null](BrightnessLevels.Count)
  private val size = Math.multiplyExact(3, Math.multiplyExact(bounds.width, bounds.height))

  def memory: Long = sums.map(s => if s == null then 0L else s.memory).sum

  def level(i: Int): ExactSums =
    val cached = sums(i)
    if cached != null then cached
    else
      val created = ExactSums(size)
      sums(i) = created
      created

  def addTo(level: Int, film: PixelBounds, to: Array[Double]): Boolean =
    val levelSums = sums(level)
    if levelSums == null then false
    else
      loop(bounds.height): y =>
        val offset =
          3 * ((bounds.y0 + y - film.y0) * film.width + bounds.x0 - film.x0)
        levelSums.addTo(to, offset, 3 * y * bounds.width, 3 * bounds.width)
      true

  def save(to: CheckedOutput): Unit =
    to.int(sums.count(_ != null))
    loop(sums.length): i =>
      val levelSums = sums(i)
      if levelSums != null then
        to.int(i)
        levelSums.save(to)

  def load(from: CheckedInput): Unit =
    loop(from.count(bytes = 4))(_ => level(from.int()).load(from))

/** Adds samples to [[BrightnessLevels]]. Mutable, one per worker. */
final class LevelPass private[film] (blocks: Vector[LevelBlock]):
  import BrightnessLevels.*
  private var block = blocks.head
  private var lower = -1
  private var lowerShare, upperShare = 0.0
  private var r, g, b = 0f

  /** Selects the tile. */
  def selectTile(tile: Int): Unit = block = blocks(tile)

  /** Selects the sample that [[add]] adds. */
  def sample(r: Float, g: Float, b: Float): Unit =
    this.r = r
    this.g = g
    this.b = b
    val bright = Math.max(r, Math.max(g, b))
    if bright <= 0f then lower = -1
    else
      val exponent = Math.floorDiv(Math.getExponent(bright), 3)
      lower = Math.max(0, Math.min(Count - 1, exponent - FirstExponent))
      lowerShare =
        if exponent < FirstExponent || exponent - FirstExponent >= Count - 1 then 1
        else (brightness(lower) / bright.toDouble - 0.125) / 0.875
      upperShare = 1 - lowerShare

  /** Adds the sample to a pixel of the tile, by its number. */
  def add(pixel: Int, weight: Double): Unit =
    if lower >= 0 then
      if lowerShare > 0 then addTo(lower, pixel, weight * lowerShare)
      if upperShare > 0 then addTo(lower + 1, pixel, weight * upperShare)

  private def addTo(level: Int, pixel: Int, weight: Double): Unit =
    val sums = block.level(level)
    sums.add(3 * pixel, weight * r)
    sums.add(3 * pixel + 1, weight * g)
    sums.add(3 * pixel + 2, weight * b)
