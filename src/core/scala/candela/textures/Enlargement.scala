package candela.textures

import candela.base.loop
import candela.math.*

/** How an image is enlarged to edges that are powers of two, as in pbrt: first across, then down,
  * each time by four texels of a Lanczos-windowed sinc.
  *
  * Source: Lanczos, "Applied Analysis", 1956.
  *
  * @param maxValue upper limit of new texels
  */
private[textures] final class Enlargement(
    fromWidth: Int,
    fromHeight: Int,
    channels: Int,
    wrap: Wrap,
    maxValue: Float
):
  import Enlargement.*

  val width: Int = Pyramid.powerOfTwo(fromWidth)
  val height: Int = Pyramid.powerOfTwo(fromHeight)

  /** Whether the image stays as it is. */
  def isNone: Boolean = width == fromWidth && height == fromHeight

  /** Numbers of a new row. */
  val length: Int = width * channels

  private lazy val across = weights(fromWidth, width)
  private lazy val down = weights(fromHeight, height)

  /** Resamples the row `y` across.
    *
    * @param source its numbers
    * @param to     receives the new ones from `start` on; zero before
    * @param texel  a channel of an old texel, by its index
    */
  def widen(y: Int, source: Array[Float], to: Array[Float], start: Int)(
      texel: (Int, Int) => Float
  ): Unit =
    loop(width): x =>
      val firstTexel = across.firstTap(x)
      if firstTexel >= 0 && firstTexel + Taps <= fromWidth then
        val i = firstTexel * channels
        loop(channels): c =>
          var sum = 0f
          loop(Taps): k =>
            sum += across.weight(Taps * x + k) * source(i + k * channels + c)
          to(start + x * channels + c) = sum
      else
        loop(Taps): k =>
          val i = wrap.index(firstTexel + k, y, fromWidth, fromHeight)
          if i >= 0 then
            val weight = across.weight(Taps * x + k)
            loop(channels)(c => to(start + x * channels + c) += weight * texel(i, c))

  /** Whether the new row `y` needs rows beyond the image. */
  def isBeyond(y: Int): Boolean = down.firstTap(y) < 0 || down.firstTap(y) + Taps > fromHeight

  /** The first of the old rows that the new row `y` needs, unless it is beyond the image. */
  def firstOf(y: Int): Int = Math.max(0, down.firstTap(y))

  /** The last of them. */
  def lastOf(y: Int): Int = Math.min(fromHeight, down.firstTap(y) + Taps) - 1

  /** Resamples down, for contiguous access row by row.
    *
    * @param wide has rows that were resampled across
    * @param to   receives the new row `y` from `start` on; zero before
    * @param offsetOf where an old row begins
    */
  def heighten(
      y: Int,
      wide: Array[Float],
      to: Array[Float],
      start: Int
  )(offsetOf: Int => Int): Unit =
    loop(Taps): k =>
      val row = down.firstTap(y) + k
      val weight = down.weight(Taps * y + k)
      if row >= 0 && row < fromHeight then add(wide, offsetOf(row), weight, to, start, length)
      else
        loop(width): x =>
          val i = wrap.index(x, row, width, fromHeight)
          if i >= 0 then
            val offset = offsetOf(i / width) + i % width * channels
            add(wide, offset, weight, to, start + x * channels, channels)
    loop(length)(k => to(start + k) = clamp(to(start + k), 0f, maxValue))

/** The latest rows of an image, and those at its upper and lower edge. */
private[textures] final class EdgedRows(height: Int, length: Int):
  import EdgedRows.*
  val values = new Array[Float]((Latest + 2 * Edge) * length)

  /** Where a row begins. */
  def offsetOf(y: Int): Int =
    val slot =
      if y < Edge then Latest + y
      else if isEdge(y, height) then Latest + Edge + y - (height - Edge)
      else y % Latest
    slot * length

  def clear(y: Int): Unit = java.util.Arrays.fill(values, offsetOf(y), offsetOf(y) + length, 0f)

private[textures] object EdgedRows:
  private val Latest = 8
  private val Edge = 2

  /** Whether a row is at the upper or lower edge. */
  def isEdge(y: Int, height: Int): Boolean = y < Edge || y >= height - Edge

private[textures] object Enlargement:

  private def add(
      from: Array[Float],
      start: Int,
      weight: Float,
      to: Array[Float],
      at: Int,
      length: Int
  ): Unit =
    var i = 0
    while i < length do
      to(at + i) += weight * from(start + i)
      i += 1

  /** For each new texel the first of four old ones, and their weights. */
  private final class Weights(val firstTap: Array[Int], val weight: Array[Float])

  private val Taps = 4

  /** Over two old texels to each side. */
  private def weights(from: Int, to: Int): Weights =
    val firstTap = new Array[Int](to)
    val weight = new Array[Float](to * Taps)
    loop(to): i =>
      val center = (i + 0.5) * from / to
      firstTap(i) = Math.floor(center - 2 + 0.5).toInt
      val raw = Array.tabulate(Taps)(k => lanczos((firstTap(i) + k + 0.5 - center) / 2))
      loop(Taps)(k => weight(Taps * i + k) = (raw(k) / raw.sum).toFloat)
    Weights(firstTap, weight)

  private def lanczos(x: Double): Double =
    if Math.abs(x) > 1 then 0 else sinc(x) * sinc(2 * x)

  private def sinc(x: Double): Double =
    if Math.abs(x) < 1e-5 then 1 else Math.sin(Math.PI * x) / (Math.PI * x)
