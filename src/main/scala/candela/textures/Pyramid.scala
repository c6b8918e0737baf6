package candela.textures

import scala.collection.mutable.ArrayBuffer

import candela.base.loop
import candela.math.*

/** A picture and its halves, each the mean of four texels of the one before, down to one texel.
  *
  * Source: Williams, "Pyramidal Parametrics", SIGGRAPH 1983.
  */
object Pyramid:

  /** @param most what texels between those of the picture are limited to: a picture whose width
    *             or height is no power of two is first enlarged until they are, as in pbrt
    */
  def of(texels: Texels, wrap: Wrap, most: Float): Array[MipLevel] =
    val levels = ArrayBuffer(enlarged(texels, wrap, most))
    while levels.last.width > 1 || levels.last.height > 1 do levels += halved(levels.last)
    levels.map(MipLevel(_, wrap)).toArray

  /** Of an edge of one texel, that texel counts twice. */
  private def halved(from: Texels): Texels =
    val width = Math.max(1, from.width / 2)
    val height = Math.max(1, from.height / 2)
    val right = if from.width > 1 then 1 else 0
    val below = if from.height > 1 then from.width else 0
    val values = new Array[Float](width * height * from.channels)
    loop(height): y =>
      loop(width): x =>
        val i = y * (1 + Math.min(1, below)) * from.width + x * (1 + right)
        loop(from.channels): c =>
          val upper = from(i, c) + from(i + right, c)
          val lower = from(i + below, c) + from(i + below + right, c)
          values((y * width + x) * from.channels + c) = 0.25f * (upper + lower)
    FloatTexels(width, height, from.channels, values)

  private def enlarged(from: Texels, wrap: Wrap, most: Float): Texels =
    val width = powerOfTwo(from.width)
    val height = powerOfTwo(from.height)
    if width == from.width && height == from.height then from
    else
      val channels = from.channels
      val wide = new Array[Float](width * from.height * channels)
      val across = weights(from.width, width)
      loop(from.height): y =>
        loop(width): x =>
          loop(Taps): k =>
            val i = wrap.index(across.first(x) + k, y, from.width, from.height)
            if i >= 0 then
              loop(channels): c =>
                wide((y * width + x) * channels + c) += across.weight(Taps * x + k) * from(i, c)
      val values = new Array[Float](width * height * channels)
      val down = weights(from.height, height)
      loop(height): y =>
        loop(width): x =>
          loop(Taps): k =>
            val i = wrap.index(x, down.first(y) + k, width, from.height)
            if i >= 0 then
              loop(channels): c =>
                values((y * width + x) * channels + c) +=
                  down.weight(Taps * y + k) * wide(i * channels + c)
      loop(values.length)(i => values(i) = clamp(values(i), 0f, most))
      FloatTexels(width, height, channels, values)

  private def powerOfTwo(n: Int): Int =
    if Integer.bitCount(n) == 1 then n else Integer.highestOneBit(n) << 1

  /** For each new texel the first of four old ones, and their weights. */
  private final class Weights(val first: Array[Int], val weight: Array[Float])

  private val Taps = 4

  /** Lanczos's windowed sinc over two old texels to each side (Lanczos, "Applied Analysis", 1956).
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
