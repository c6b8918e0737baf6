package candela.film

import candela.base.{CheckedInput, CheckedOutput, loop}
import candela.color.{ColorBasis, Rgb}

import java.util.concurrent.atomic.{AtomicLongArray, LongAdder}

/** Accumulates splats of light paths, in addition to [[Film]].
  *
  * Any worker may add to any pixel at any time. Accumulators are integers in two parts, so the sums
  * are bit-identical in any order. A value is rounded to a multiple of 2⁻¹⁶, and the remainder to
  * one of 2⁻⁵⁴; the accumulators hold up to 10¹⁴ and 2³⁸ remainders.
  *
  * @param filter distributes a splat over pixels
  * @param pixels of the full image
  * @param limit  of a splat, as of a sample
  */
final class SplatFilm(
    x0: Int,
    y0: Int,
    x1: Int,
    y1: Int,
    filter: Filter,
    pixels: Double,
    basis: ColorBasis,
    limit: Option[SampleLimit]
) extends Splats:
  import SplatFilm.*
  private val width = x1 - x0
  private val height = y1 - y0
  private val most: SampleLimit | Null = limit.orNull
  private val volume = filter.integral

  // For each pixel, row by row, and each channel: the coarse part, then the fine one
  private val sums = AtomicLongArray(Math.multiplyExact(6, Math.multiplyExact(width, height)))
  private val paths = LongAdder()

  def begin(): Unit = paths.increment()

  /** Number of light paths. */
  def pathCount: Long = paths.sum

  def add(x: Float, y: Float, light: Rgb): Unit =
    val seen = basis.toSrgb(light)
    if seen.isFinite && !seen.isBlack then
      val limited = if most == null then seen else seen * most.scale(seen)
      val left = Math.max(x0, Math.ceil(x - 0.5 - filter.radiusX).toInt)
      val right = Math.min(x1 - 1, Math.floor(x - 0.5 + filter.radiusX).toInt)
      val top = Math.max(y0, Math.ceil(y - 0.5 - filter.radiusY).toInt)
      val bottom = Math.min(y1 - 1, Math.floor(y - 0.5 + filter.radiusY).toInt)
      var py = top
      while py <= bottom do
        val share = filter.y(y - 0.5f - py)
        var px = left
        while px <= right do
          val weight = share * filter.x(x - 0.5f - px)
          if weight != 0f then addTo(6 * ((py - y0) * width + px - x0), limited * weight)
          px += 1
        py += 1

  private def addTo(at: Int, light: Rgb): Unit =
    if light.max < Largest then
      addTo(at, light.r.toDouble)
      addTo(at + 2, light.g.toDouble)
      addTo(at + 4, light.b.toDouble)

  private def addTo(at: Int, value: Double): Unit =
    val coarse = Math.rint(value * Coarse)
    val _ = sums.getAndAdd(at, coarse.toLong)
    // Exact, as both have the precision of a Float
    val rest = value - coarse / Coarse
    val _ = sums.getAndAdd(at + 1, Math.rint(rest * Fine).toLong)

  def copy(): SplatFilm =
    val film = SplatFilm(x0, y0, x1, y1, filter, pixels, basis, limit)
    loop(sums.length)(i => film.sums.set(i, sums.get(i)))
    film.paths.add(paths.sum)
    film

  /** The delta since `earlier` was copied. */
  def since(earlier: SplatFilm): SplatFilm =
    val film = copy()
    loop(sums.length): i =>
      val _ = film.sums.addAndGet(i, -earlier.sums.get(i))
    film.paths.add(-earlier.paths.sum)
    film

  def save(to: CheckedOutput): Unit =
    to.long(paths.sum)
    loop(sums.length)(i => to.long(sums.get(i)))

  /** Adds what was saved. */
  def load(from: CheckedInput): Unit =
    paths.add(from.long())
    loop(sums.length): i =>
      val _ = sums.addAndGet(i, from.long())

  /** Adds the normalised splats, times `scale`, to pixel values, row by row. */
  def addTo(data: Array[Float], scale: Float): Unit =
    val count = paths.sum
    if count > 0 then
      val factor = scale * pixels / (count * volume)
      loop(data.length): i =>
        val value = sums.get(2 * i) / Coarse + sums.get(2 * i + 1) / Fine
        data(i) += (value * factor).toFloat

object SplatFilm:
  private val Coarse: Double = 65536.0
  private val Fine: Double = 18014398509481984.0 // 2⁵⁴

  /** Larger single contributions are discarded, lest they overflow the accumulators. */
  private val Largest = 1e9f
