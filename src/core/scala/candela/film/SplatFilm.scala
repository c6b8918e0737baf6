package candela.film

import candela.base.{CheckedInput, CheckedOutput, loop}
import candela.color.{ColorBasis, Rgb}

import java.util.concurrent.atomic.LongAdder

/** Accumulates splats of light paths, in addition to [[Film]].
  *
  * Any worker may add to any pixel at any time. Accumulators are integers, so the sums are
  * bit-identical in any order: multiples of 2⁻⁵⁴, of which whole multiples of 2⁻¹⁶ are moved to a
  * second part when they become large, up to 10¹⁴.
  *
  * Bands of rows have a lock each. A splat takes one or two of them: an atomic addition for each
  * number took four times as long, as a splat under a wide filter adds some fifty.
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

  // For each pixel, row by row, and each channel
  private val fine = new Array[Long](Math.multiplyExact(3, Math.multiplyExact(width, height)))
  private val coarse = new Array[Long](fine.length)

  /** Rows of a band: a splat reaches two at most. */
  private val rows = Math.max(LeastRows, Math.ceil(2.0 * filter.radiusY).toInt + 1)
  private val bands = Array.fill((height + rows - 1) / rows)(Band(columns))
  private def columns = Math.ceil(2.0 * filter.radiusX).toInt + 1
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
      if left <= right && top <= bottom then
        val upper = bands((top - y0) / rows)
        val lower = bands((bottom - y0) / rows)
        // Always in this order, so that no two threads wait for each other
        upper.synchronized:
          lower.synchronized:
            loop(right - left + 1)(i => upper.across(i) = filter.x(x - 0.5f - (left + i)))
            var py = top
            while py <= bottom do
              val at = 3 * ((py - y0) * width + left - x0)
              addRow(at, limited, filter.y(y - 0.5f - py), upper.across, right - left + 1)
              py += 1

  private def addRow(at: Int, light: Rgb, share: Float, across: Array[Float], count: Int): Unit =
    loop(count): i =>
      val weight = share * across(i)
      if weight != 0f then addTo(at + 3 * i, light * weight)

  private def addTo(at: Int, light: Rgb): Unit =
    if light.max < Largest then
      addTo(at, light.r)
      addTo(at + 1, light.g)
      addTo(at + 2, light.b)

  private def addTo(at: Int, value: Float): Unit =
    if Math.abs(value) < Bright then addFine(at, value.toDouble)
    else
      val whole = Math.rint(value * Coarse)
      coarse(at) += whole.toLong
      // Exact, as both have the precision of a Float
      addFine(at, value - whole / Coarse)

  /** @param value below [[Bright]], so that two don't overflow */
  private def addFine(at: Int, value: Double): Unit =
    val sum = fine(at) + Math.rint(value * Fine).toLong
    if Math.abs(sum) < Full then fine(at) = sum
    else
      coarse(at) += sum >> FineBits
      fine(at) = sum & FineMask

  // The same two numbers whatever the order of the additions
  private def coarseOf(i: Int): Long = coarse(i) + (fine(i) >> FineBits)
  private def fineOf(i: Int): Long = fine(i) & FineMask

  /** Calls `f` for each number, while no splat is added to it. */
  private inline def each(inline f: Int => Unit): Unit =
    val perBand = 3 * rows * width
    loop(bands.length): b =>
      bands(b).synchronized:
        val end = Math.min((b + 1) * perBand, fine.length)
        var i = b * perBand
        while i < end do
          f(i)
          i += 1

  def copy(): SplatFilm =
    val film = SplatFilm(x0, y0, x1, y1, filter, pixels, basis, limit)
    each: i =>
      film.coarse(i) = coarseOf(i)
      film.fine(i) = fineOf(i)
    film.paths.add(paths.sum)
    film

  /** The delta since `earlier` was copied. */
  def since(earlier: SplatFilm): SplatFilm =
    val film = copy()
    film.each: i =>
      film.coarse(i) -= earlier.coarse(i)
      film.fine(i) -= earlier.fine(i)
    film.paths.add(-earlier.paths.sum)
    film

  def save(to: CheckedOutput): Unit =
    to.long(paths.sum)
    each: i =>
      to.long(coarseOf(i))
      to.long(fineOf(i))

  /** Adds what was saved. */
  def load(from: CheckedInput): Unit =
    paths.add(from.long())
    each: i =>
      coarse(i) += from.long()
      fine(i) += from.long()

  /** Adds the normalised splats, times `scale`, to pixel values, row by row. */
  def addTo(data: Array[Float], scale: Float): Unit =
    val count = paths.sum
    if count > 0 then
      val factor = scale * pixels / (count * volume)
      each: i =>
        data(i) += ((coarseOf(i) / Coarse + fineOf(i) / Fine) * factor).toFloat

object SplatFilm:
  /** So that few splats take two locks, and threads seldom meet. */
  private val LeastRows = 8

  /** The lock of some rows, and memory for the weights of a splat whose first row is among them. */
  private final class Band(columns: Int):
    val across = new Array[Float](columns)

  // Steps per unit
  private inline val Coarse = 65536.0
  private inline val Fine = 18014398509481984.0 // 2⁵⁴

  /** Digits of the fine part below the coarse one's. */
  private inline val FineBits = 38
  private inline val FineMask = (1L << FineBits) - 1

  /** Larger values go to both parts. */
  private inline val Bright = 128f

  /** Fine parts from here on are made small again. */
  private inline val Full = 1L << 61

  /** Larger single contributions are discarded, lest they overflow the accumulators. */
  private val Largest = 1e9f
