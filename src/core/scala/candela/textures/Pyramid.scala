package candela.textures

import scala.collection.mutable.ArrayBuffer

import candela.base.{loop, Parallel}
import candela.math.*

/** Builds MIP maps: an image and its reductions, each averaging four texels of the previous one,
  * down to one texel.
  *
  * Source: Williams, "Pyramidal Parametrics", SIGGRAPH 1983.
  */
object Pyramid:

  /** @param most     upper limit of resampled texels: an image whose width or height is no power of
    *   two is first enlarged to one, as in pbrt
    * @param parallel executes rows of texels
    */
  def of(
      texels: Texels,
      wrap: Wrap,
      most: Float,
      parallel: Parallel = Parallel.Alone
  ): Array[MipLevel] =
    levels(texels, wrap, most, parallel).map(MipLevel(_, wrap))

  /** The texels of each level. */
  def levels(texels: Texels, wrap: Wrap, most: Float, parallel: Parallel): Array[Texels] =
    val levels = ArrayBuffer(enlarged(texels, wrap, most, parallel))
    while levels.last.width > 1 || levels.last.height > 1 do levels += halved(levels.last, parallel)
    levels.toArray

  /** Number of levels of an image. */
  def size(width: Int, height: Int): Int =
    Integer.numberOfTrailingZeros(powerOfTwo(Math.max(width, height))) + 1

  /** If an edge is one texel long, that texel counts twice. */
  private def halved(from: Texels, parallel: Parallel): Texels =
    val width = Math.max(1, from.width / 2)
    val height = Math.max(1, from.height / 2)
    val channels = from.channels
    val across = if from.width > 1 then 2 else 1
    val down = if from.height > 1 then 2 else 1
    val right = (across - 1) * channels
    val values = new Array[Float](width * height * channels)
    rows(parallel, width, height)(() => Rows(from)): (y, source) =>
      from.row(y * down, source.upper)
      from.row(y * down + down - 1, source.lower)
      halve(source, values, y * width * channels, width, channels, across * channels, right)
    FloatTexels(width, height, from.channels, values)

  /** Two rows of texels, channels interleaved. */
  private final class Rows(from: Texels):
    val upper, lower = new Array[Float](from.width * from.channels)

  /** @param step  distance of two new texels' first texels
    * @param right distance of the right neighbour
    */
  private def halve(
      from: Rows,
      to: Array[Float],
      start: Int,
      width: Int,
      channels: Int,
      step: Int,
      right: Int
  ): Unit =
    loop(width): x =>
      val i = x * step
      loop(channels): c =>
        val upper = from.upper(i + c) + from.upper(i + c + right)
        val lower = from.lower(i + c) + from.lower(i + c + right)
        to(start + x * channels + c) = 0.25f * (upper + lower)

  private[textures] def enlarged(
      from: Texels,
      wrap: Wrap,
      most: Float,
      parallel: Parallel = Parallel.Alone
  ): Texels =
    val width = powerOfTwo(from.width)
    val height = powerOfTwo(from.height)
    if width == from.width && height == from.height then from
    else
      val wide = widened(from, wrap, width, parallel)
      val values = heightened(wide, from, wrap, width, height, parallel)
      rows(parallel, width * from.channels, height)(() => ()): (y, _) =>
        val start = y * width * from.channels
        loop(width * from.channels): k =>
          values(start + k) = clamp(values(start + k), 0f, most)
      FloatTexels(width, height, from.channels, values)

  /** Resamples rows to `width` texels each. */
  private def widened(from: Texels, wrap: Wrap, width: Int, parallel: Parallel): Array[Float] =
    val channels = from.channels
    val wide = new Array[Float](width * from.height * channels)
    val across = weights(from.width, width)
    rows(parallel, width, from.height)(() => Rows(from)): (y, source) =>
      from.row(y, source.upper)
      val start = y * width * channels
      loop(width): x =>
        val first = across.first(x)
        if first >= 0 && first + Taps <= from.width then
          val i = first * channels
          loop(channels): c =>
            var sum = 0f
            loop(Taps): k =>
              sum += across.weight(Taps * x + k) * source.upper(i + k * channels + c)
            wide(start + x * channels + c) = sum
        else
          loop(Taps): k =>
            val i = wrap.index(first + k, y, from.width, from.height)
            if i >= 0 then
              val weight = across.weight(Taps * x + k)
              loop(channels)(c => wide(start + x * channels + c) += weight * from(i, c))
    wide

  /** Resamples the columns of `wide` to `height` texels each: row by row, for contiguous access.
    */
  private def heightened(
      wide: Array[Float],
      from: Texels,
      wrap: Wrap,
      width: Int,
      height: Int,
      parallel: Parallel
  ): Array[Float] =
    val channels = from.channels
    val length = width * channels
    val values = new Array[Float](length * height)
    val down = weights(from.height, height)
    rows(parallel, width, height)(() => ()): (y, _) =>
      loop(Taps): k =>
        val row = down.first(y) + k
        val weight = down.weight(Taps * y + k)
        val at = y * length
        if row >= 0 && row < from.height then add(wide, row * length, weight, values, at, length)
        else
          loop(width): x =>
            val i = wrap.index(x, row, width, from.height)
            if i >= 0 then add(wide, i * channels, weight, values, at + x * channels, channels)
    values

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

  /** Executes rows of an image, in parallel unless it is small.
    *
    * @param scratch makes a thread's own memory
    */
  private def rows[A](parallel: Parallel, width: Int, height: Int)(scratch: () => A)(
      row: (Int, A) => Unit
  ): Unit =
    def strip(from: Int, until: Int): Unit =
      val own = scratch()
      var y = from
      while y < until do
        row(y, own)
        y += 1
    if width.toLong * height < SmallPicture then strip(0, height)
    else
      val strips = Math.min(height, 4 * parallel.threads)
      def start(k: Int) = (height.toLong * k / strips).toInt
      parallel.each(strips)(k => strip(start(k), start(k + 1)))

  /** Number of texels below which threads do not pay. */
  private val SmallPicture = 1L << 14

  private def powerOfTwo(n: Int): Int =
    if Integer.bitCount(n) == 1 then n else Integer.highestOneBit(n) << 1

  /** For each new texel the first of four old ones, and their weights. */
  private final class Weights(val first: Array[Int], val weight: Array[Float])

  private val Taps = 4

  /** Lanczos-windowed sinc over two old texels to each side (Lanczos, "Applied Analysis", 1956).
    */
  private def weights(from: Int, to: Int): Weights =
    val first = new Array[Int](to)
    val weight = new Array[Float](to * Taps)
    loop(to): i =>
      val center = (i + 0.5) * from / to
      first(i) = Math.floor(center - 2 + 0.5).toInt
      val raw = Array.tabulate(Taps)(k => lanczos((first(i) + k + 0.5 - center) / 2))
      loop(Taps)(k => weight(Taps * i + k) = (raw(k) / raw.sum).toFloat)
    Weights(first, weight)

  private def lanczos(x: Double): Double =
    if Math.abs(x) > 1 then 0 else sinc(x) * sinc(2 * x)

  private def sinc(x: Double): Double =
    if Math.abs(x) < 1e-5 then 1 else Math.sin(Math.PI * x) / (Math.PI * x)
