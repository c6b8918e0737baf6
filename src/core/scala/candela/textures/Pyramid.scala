package candela.textures

import candela.base.loop
import candela.concurrency.Parallel
import scala.collection.mutable.ArrayBuffer

/** Builds MIP maps: an image and its reductions, each averaging four texels of the previous one,
  * down to one texel.
  *
  * Source: Williams, "Pyramidal Parametrics", SIGGRAPH 1983.
  */
object Pyramid:

  /** @param maxValue upper limit of resampled texels: an image whose width or height is no power of
    *   two is first enlarged to one, as in pbrt
    * @param parallel executes rows of texels
    */
  def of(
      texels: Texels,
      wrap: Wrap,
      maxValue: Float,
      parallel: Parallel = Parallel.Alone
  ): Array[MipLevel] =
    levels(texels, wrap, maxValue, parallel).map(MipLevel(_, wrap))

  /** The texels of each level. */
  def levels(texels: Texels, wrap: Wrap, maxValue: Float, parallel: Parallel): Array[Texels] =
    val levels = ArrayBuffer(enlarged(texels, wrap, maxValue, parallel))
    while levels.last.width > 1 || levels.last.height > 1 do levels += halved(levels.last, parallel)
    levels.toArray

  /** Number of levels of an image. */
  def size(width: Int, height: Int): Int =
    Integer.numberOfTrailingZeros(powerOfTwo(Math.max(width, height))) + 1

  /** Width and height of each level, as of `levels`. */
  def sizes(width: Int, height: Int): Vector[(Int, Int)] =
    Vector.iterate((powerOfTwo(width), powerOfTwo(height)), size(width, height)): (w, h) =>
      (Math.max(1, w / 2), Math.max(1, h / 2))

  private def halved(from: Texels, parallel: Parallel): Texels =
    val width = Math.max(1, from.width / 2)
    val height = Math.max(1, from.height / 2)
    val channels = from.channels
    val down = if from.height > 1 then 2 else 1
    val values = new Array[Float](width * height * channels)
    rows(parallel, width, height)(() => Rows(from)): (y, source) =>
      from.row(y * down, source.upper)
      from.row(y * down + down - 1, source.lower)
      halve(source.upper, source.lower, from.width, channels, values, y * width * channels)
    FloatTexels(width, height, from.channels, values)

  /** Two rows of texels, channels interleaved. */
  private final class Rows(from: Texels):
    val upper, lower = new Array[Float](from.width * from.channels)

  /** One row from two, of `width` texels. If an edge is one texel long, that texel counts twice. */
  private[textures] def halve(
      upper: Array[Float],
      lower: Array[Float],
      width: Int,
      channels: Int,
      to: Array[Float],
      start: Int
  ): Unit =
    val across = if width > 1 then 2 else 1
    val (step, right) = (across * channels, (across - 1) * channels)
    loop(Math.max(1, width / 2)): x =>
      val i = x * step
      loop(channels): c =>
        val above = upper(i + c) + upper(i + c + right)
        val below = lower(i + c) + lower(i + c + right)
        to(start + x * channels + c) = 0.25f * (above + below)

  private[textures] def enlarged(
      from: Texels,
      wrap: Wrap,
      maxValue: Float,
      parallel: Parallel = Parallel.Alone
  ): Texels =
    val enlargement = Enlargement(from.width, from.height, from.channels, wrap, maxValue)
    if enlargement.isNone then from
    else
      val values = new Array[Float](enlargement.length * enlargement.height)
      strips(parallel, enlargement.width, enlargement.height)(enlarge(
        from, enlargement, values, _, _
      ))
      FloatTexels(enlargement.width, enlargement.height, from.channels, values)

  /** Makes some of the new rows, while few of the old ones are there resampled across. */
  private def enlarge(
      from: Texels,
      enlargement: Enlargement,
      to: Array[Float],
      first: Int,
      until: Int
  ): Unit =
    val window = EdgedRows(from.height, enlargement.length)
    val source = new Array[Float](from.width * from.channels)
    def widen(y: Int): Unit =
      from.row(y, source)
      window.clear(y)
      enlargement.widen(y, source, window.values, window.offsetOf(y))((i, c) => from(i, c))
    // Those beyond an edge are at that edge or the other
    if enlargement.isBeyond(first) || enlargement.isBeyond(until - 1) then
      loop(from.height)(y => if EdgedRows.isEdge(y, from.height) then widen(y))
    var nextRow = enlargement.firstOf(first)
    loop(first, until): y =>
      loop(nextRow, enlargement.lastOf(y) + 1)(widen)
      nextRow = Math.max(nextRow, enlargement.lastOf(y) + 1)
      enlargement.heighten(y, window.values, to, y * enlargement.length)(window.offsetOf)

  /** Executes rows of an image, in parallel unless it is small.
    *
    * @param scratch makes a thread's own memory
    */
  private def rows[A](parallel: Parallel, width: Int, height: Int)(scratch: () => A)(
      row: (Int, A) => Unit
  ): Unit =
    strips(parallel, width, height): (from, until) =>
      val workspace = scratch()
      loop(from, until)(row(_, workspace))

  /** Executes strips of rows, from one until another. */
  private def strips(parallel: Parallel, width: Int, height: Int)(
      strip: (Int, Int) => Unit
  ): Unit =
    if width.toLong * height < SmallPicture then strip(0, height)
    else
      val strips = Math.min(height, 4 * parallel.threads)
      def start(k: Int) = (height.toLong * k / strips).toInt
      parallel.forEach(strips)(k => strip(start(k), start(k + 1)))

  /** Number of texels below which threads do not pay. */
  private val SmallPicture = 1L << 14

  private[textures] def powerOfTwo(n: Int): Int =
    if Integer.bitCount(n) == 1 then n else Integer.highestOneBit(n) << 1
