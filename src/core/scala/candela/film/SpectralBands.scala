package candela.film

import candela.base.loop
import java.util.Locale

import candela.color.{ColorResponse, Colorimetry, Detector, Wavelengths}
import candela.image.Image
import candela.math.lerp

/** Average spectral radiance in wavelength bands of equal width: pbrt-v4's film "spectral". Light
  * has three components; its spectrum is reconstructed by [[ColorResponse]], so spectral lines are
  * not resolved.
  *
  * Channel names follow Fichet, Pacanowski, Wilkie, "An OpenEXR Layout for Spectral Images", JCGT
  * 10(3), 2021.
  *
  * @param from, to wavelengths in nm
  * @param bases    of which each path has one, if rendering is spectral
  */
final class SpectralBands(
    count: Int,
    from: Float,
    to: Float,
    bases: Vector[Wavelengths] = Vector.empty
):
  import SpectralBands.*

  /** Named by the centre wavelength, with a decimal comma: a dot would start a layer name. */
  val channels: Vector[String] = Vector.tabulate(count): band =>
    val middle = lerp((band + 0.5f) / count, from, to)
    s"S0.${String.format(Locale.ROOT, "%.3f", middle).replace('.', ',')}nm"

  /** The band of a wavelength in nm; −1: none. */
  def bandOf(nm: Float): Int =
    if nm < from || nm >= to then -1
    else Math.min(((nm - from) / (to - from) * count).toInt, count - 1)

  /** The same, in a rendering whose paths have these wavelengths. */
  def withBases(bases: Vector[Wavelengths]): SpectralBands = SpectralBands(count, from, to, bases)

  private lazy val widths =
    val sums = new Array[Double](count)
    for basis <- bases; i <- 0 to 2; band = bandOf(basis.nm(i)) if band >= 0 do
      sums(band) += basis.weight(i)
    sums.map(_ / bases.size)

  /** Width of the spectrum that a path's wavelengths within the band stand for, on average, in nm.
    */
  def width(band: Int): Double = widths(band)

  def describe: String = s"$count from $from to $to nm"

  private lazy val response = ColorResponse(Vector.tabulate(count): band =>
    val nm = Array.tabulate(Points)(i => lerp((band + (i + 0.5f) / Points) / count, from, to))
    Detector(nm, nm.map(l => Colorimetry.radianceOfD65(l) / Points)))

  /** Appends the bands to the image's channels.
    *
    * @param colors incident light in linear sRGB
    */
  def appendTo(image: Image, colors: Image): Image =
    require(image.width == colors.width && image.height == colors.height)
    val width = image.channels + count
    val data = new Array[Float](width * image.width * image.height)
    loop(image.width * image.height): pixel =>
      System.arraycopy(image.data, image.channels * pixel, data, width * pixel, image.channels)
      val offset = 3 * pixel
      val c = colors.data
      response(c(offset), c(offset + 1), c(offset + 2), data, width * pixel + image.channels)
    val names = image.channelNames ++ channels
    Image(image.width, image.height, names, data, colorSpace = image.colorSpace)

object SpectralBands:
  /** Attributes that the layout requires. */
  val metadata: Vector[(String, String)] =
    Vector("spectralLayoutVersion" -> "1.0", "emissiveUnits" -> "W.m^-2.sr^-1")

  /** Number of equidistant wavelengths per band. */
  private inline val Points = 8
