package candela.film

import candela.base.loop
import candela.io.{CheckedInput, CheckedOutput}
import candela.color.{Rgb, Wavelengths}
import candela.image.Image

/** Accumulates the light of camera samples in wavelength bands, at the wavelengths of each sample.
  * One worker at a time owns a pixel, as in [[Film]].
  *
  * A band's value is the mean over the samples within it, weighted by the filter and the density of
  * wavelengths.
  */
final class BandFilm(bands: SpectralBands, bounds: PixelBounds):
  private val x0 = bounds.x0
  private val y0 = bounds.y0
  private val width = bounds.width
  private val height = bounds.height
  private val count = bands.channels.size

  // For each pixel and band: weighted light, sum of weights
  private val sums = ExactSums(Math.multiplyExact(2 * count, Math.multiplyExact(width, height)))

  /** Adds light to its pixel.
    *
    * @param light at the wavelengths of `basis`
    */
  def add(x: Int, y: Int, basis: Wavelengths, light: Rgb, weight: Float): Unit =
    val first = 2 * count * ((y - y0) * width + (x - x0))
    add(first, basis, 0, light.r, weight)
    add(first, basis, 1, light.g, weight)
    add(first, basis, 2, light.b, weight)

  private def add(first: Int, basis: Wavelengths, i: Int, light: Float, weight: Float): Unit =
    val band = bands.bandOf(basis.nm(i))
    if band >= 0 then
      val share = basis.weight(i).toDouble * weight
      sums.add(first + 2 * band, share * light)
      sums.add(first + 2 * band + 1, share)

  /** Appends the bands to the image's channels.
    *
    * @param splats of light paths, if any
    */
  def appendTo(image: Image, splats: Option[SplatFilm]): Image =
    require(image.width == width && image.height == height)
    val channels = image.channels + count
    val data = new Array[Float](channels * width * height)
    loop(width * height): pixel =>
      System.arraycopy(image.data, image.channels * pixel, data, channels * pixel, image.channels)
      loop(count): band =>
        val offset = 2 * (count * pixel + band)
        val weight = sums(offset + 1)
        if weight != 0 then
          val mean = sums(offset) / weight
          data(channels * pixel + image.channels + band) = (mean * Wavelengths.Radiance).toFloat
    splats.foreach(_.addBandsTo(data, channels, Wavelengths.Radiance))
    Image(width, height, image.channelNames ++ bands.channels, data)

  def save(to: CheckedOutput): Unit = sums.save(to)
  def load(from: CheckedInput): Unit = sums.load(from)
