package candela.film

import candela.base.loop
import candela.io.{CheckedInput, CheckedOutput}
import candela.color.{ColorBasis, Rgb, Wavelengths}

import java.util.concurrent.atomic.LongAdder

/** Accumulates splats of light paths, in addition to [[Film]].
  *
  * Any worker may add to any pixel at any time. Accumulators are integers, so the sums are
  * bit-identical in any order: multiples of 2⁻⁵⁴, of which whole multiples of 2⁻¹⁶ are moved to a
  * second part when they become large, up to 10¹⁴.
  *
  * Strips of rows have a lock each. A splat takes one or two of them: an atomic addition for each
  * number took four times as long, as a splat under a wide filter adds some fifty.
  *
  * @param filter distributes a splat over pixels
  * @param pixels of the full image
  * @param limits of a splat, as of a sample's indirect light and of a sample
  * @param groups of lights that are told apart
  * @param bands  of wavelengths to accumulate, too
  * @param strategies whose light is kept beside the image
  */
final class SplatFilm(
    bounds: PixelBounds,
    filter: Filter,
    pixels: Double,
    basis: ColorBasis,
    limits: Vector[SampleLimit],
    groups: Int = 1,
    bands: Option[SpectralBands] = None,
    strategies: Int = 0
) extends Splats:
  import SplatFilm.*
  private val x0 = bounds.x0
  private val y0 = bounds.y0
  private val x1 = bounds.x1
  private val y1 = bounds.y1
  private val width = bounds.width
  private val height = bounds.height
  private val clamps = limits.toArray
  private val spectrum: SpectralBands | Null = bands.orNull
  private val volume = filter.integral

  // Colours of each group of lights, and of each strategy, then bands
  private val colors = 3 * (groups + strategies)
  private val channels = colors + bands.fold(0)(_.channels.size)

  // For each pixel, row by row, and each channel
  private val fine =
    new Array[Long](Math.multiplyExact(channels, Math.multiplyExact(width, height)))
  private val coarse = new Array[Long](fine.length)

  /** Rows of a strip: a splat reaches two at most. */
  private val rows = Math.max(MinRows, Math.ceil(2.0 * filter.radiusY).toInt + 1)
  private val strips = Array.fill((height + rows - 1) / rows)(Strip(columns))
  private def columns = Math.ceil(2.0 * filter.radiusX).toInt + 1
  private val samples = LongAdder()

  def countSample(): Unit = samples.increment()

  /** Number of samples. */
  def sampleCount: Long = samples.sum

  def add(x: Float, y: Float, light: Rgb, group: Int): Unit =
    splat(x, y, light, if groups == 1 then 0 else 3 * group)

  override def addStrategy(x: Float, y: Float, light: Rgb, strategy: Int): Unit =
    splat(x, y, light, 3 * (groups + strategy))

  private def splat(x: Float, y: Float, light: Rgb, channel: Int): Unit =
    val color = basis.toSrgb(light)
    if color.isFinite && !color.isBlack then
      val limited = clamped(color)
      spread(x, y)((pixel, weight) => addTo(channels * pixel + channel, limited * weight))

  private def clamped(light: Rgb): Rgb =
    var limited = light
    loop(clamps.length)(i => limited = limited * clamps(i).scale(limited))
    limited

  def addToBands(x: Float, y: Float, basis: Wavelengths, light: Rgb): Unit =
    val among = spectrum
    if among != null && light.isFinite && !light.isBlack then
      val shares = Rgb(
        light.r * basis.weight(0),
        light.g * basis.weight(1),
        light.b * basis.weight(2)
      )
      val first = colors
      val (r, g, b) =
        (among.bandOf(basis.nm(0)), among.bandOf(basis.nm(1)), among.bandOf(basis.nm(2)))
      spread(x, y): (pixel, weight) =>
        val offset = channels * pixel + first
        val shared = shares * weight
        if shared.max < Largest then
          if r >= 0 then addTo(offset + r, shared.r)
          if g >= 0 then addTo(offset + g, shared.g)
          if b >= 0 then addTo(offset + b, shared.b)

  /** Calls `to` with each pixel that the filter reaches from a place, and its weight. */
  private inline def spread(x: Float, y: Float)(inline to: (Int, Float) => Unit): Unit =
    val left = Math.max(x0, Math.ceil(x - 0.5 - filter.radiusX).toInt)
    val right = Math.min(x1 - 1, Math.floor(x - 0.5 + filter.radiusX).toInt)
    val top = Math.max(y0, Math.ceil(y - 0.5 - filter.radiusY).toInt)
    val bottom = Math.min(y1 - 1, Math.floor(y - 0.5 + filter.radiusY).toInt)
    if left <= right && top <= bottom then
      val upper = strips((top - y0) / rows)
      val lower = strips((bottom - y0) / rows)
      // Always in this order, so that no two threads wait for each other
      upper.synchronized:
        lower.synchronized:
          val across = upper.across
          loop(right - left + 1)(i => across(i) = filter.x(x - 0.5f - (left + i)))
          var py = top
          while py <= bottom do
            val first = (py - y0) * width + left - x0
            val share = filter.y(y - 0.5f - py)
            loop(right - left + 1): i =>
              val weight = share * across(i)
              if weight != 0f then to(first + i, weight)
            py += 1

  private def addTo(at: Int, light: Rgb): Unit =
    if light.max < Largest then
      addTo(at, light.r)
      addTo(at + 1, light.g)
      addTo(at + 2, light.b)

  private def addTo(at: Int, value: Float): Unit =
    if Math.abs(value) < Bright then addFine(at, value.toDouble)
    else
      val rounded = Math.rint(value * Coarse)
      coarse(at) += rounded.toLong
      // Exact, as both have the precision of a Float
      addFine(at, value - rounded / Coarse)

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

  /** Calls `f` for each pixel, while no splat is added to it. */
  private inline def eachPixel(inline f: Int => Unit): Unit =
    val perStrip = rows * width
    loop(strips.length): s =>
      strips(s).synchronized:
        val end = Math.min((s + 1) * perStrip, width * height)
        var pixel = s * perStrip
        while pixel < end do
          f(pixel)
          pixel += 1

  /** Likewise, for each number. */
  private inline def eachNumber(inline f: Int => Unit): Unit =
    eachPixel(pixel => loop(channels)(channel => f(channels * pixel + channel)))

  def copy(): SplatFilm =
    val film = SplatFilm(bounds, filter, pixels, basis, limits, groups, bands, strategies)
    eachNumber: i =>
      film.coarse(i) = coarseOf(i)
      film.fine(i) = fineOf(i)
    film.samples.add(samples.sum)
    film

  /** The delta since `earlier` was copied. */
  def deltaSince(earlier: SplatFilm): SplatFilm =
    val film = copy()
    film.eachNumber: i =>
      film.coarse(i) -= earlier.coarse(i)
      film.fine(i) -= earlier.fine(i)
    film.samples.add(-earlier.samples.sum)
    film

  def save(to: CheckedOutput): Unit =
    to.long(samples.sum)
    eachNumber: i =>
      to.long(coarseOf(i))
      to.long(fineOf(i))

  /** Adds what was saved. */
  def load(from: CheckedInput): Unit =
    samples.add(from.long())
    eachNumber: i =>
      coarse(i) += from.long()
      fine(i) += from.long()

  /** Adds the normalised splats, times `scale`, to pixel values, row by row. */
  def addTo(data: Array[Float], scale: Float): Unit = addTo(data, scale, 0, groups)

  /** Likewise, those of one group of lights. */
  def addTo(data: Array[Float], scale: Float, group: Int): Unit =
    addTo(data, scale, group, group + 1)

  /** Likewise, those of one strategy. */
  def addStrategyTo(data: Array[Float], scale: Float, strategy: Int): Unit =
    addTo(data, scale, groups + strategy)

  private def addTo(data: Array[Float], scale: Float, from: Int, until: Int): Unit =
    for factor <- perSample do
      val scaled = scale * factor
      eachPixel: pixel =>
        loop(3): c =>
          var sum = 0.0
          var group = from
          while group < until do
            sum += value(channels * pixel + 3 * group + c)
            group += 1
          data(3 * pixel + c) += (sum * scaled).toFloat

  /** Adds the mean in each band of wavelengths, times `scale`, to an image's channels.
    *
    * @param stride channels of the image, the last of which are the bands
    */
  def addBandsTo(data: Array[Float], stride: Int, scale: Double): Unit =
    for
      among <- bands
      factor <- perSample
    do
      val count = among.channels.size
      eachPixel: pixel =>
        loop(count): band =>
          if among.width(band) > 0 then
            val mean = value(channels * pixel + colors + band) * factor / among.width(band)
            data(stride * (pixel + 1) - count + band) += (mean * scale).toFloat

  private def value(i: Int): Double = coarseOf(i) / Coarse + fineOf(i) / Fine

  private def perSample: Option[Double] =
    val count = samples.sum
    Option.when(count > 0)(pixels / (count * volume))

object SplatFilm:
  /** So that few splats take two locks, and threads seldom meet. */
  private val MinRows = 8

  /** The lock of some rows, and memory for the weights of a splat whose first row is among them. */
  private final class Strip(columns: Int):
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
