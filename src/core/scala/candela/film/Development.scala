package candela.film

import candela.base.loop
import candela.concurrency.{GivenUp, Parallel}
import candela.color.{ColorResponse, ColorSpace}
import candela.image.{Image, PixelFormat}

/** Post-processing from pixel averages to image values.
  *
  * @param scale         scale of all values
  * @param sensor        spectral response of the camera's three channels; if empty, that of the
  *                      standard observer
  * @param balance       3 × 3 matrix, row by row, from sensor to output values; identity if empty
  * @param clipsNegative whether values below 0, which filters with negative lobes produce, are
  *                      written as 0, as in pbrt-v2 and v3
  * @param isHalf        whether values are written with 16 bits instead of 32
  * @param bands         wavelength bands written as additional channels, if any
  * @param space         colour space of the output values
  * @param format        channels of image files for the colours
  */
final case class Development(
    scale: Float = 1f,
    sensor: Option[ColorResponse] = None,
    balance: Option[Array[Float]] = None,
    clipsNegative: Boolean = false,
    isHalf: Boolean = false,
    bands: Option[SpectralBands] = None,
    space: ColorSpace = ColorSpace.Srgb,
    format: PixelFormat = PixelFormat.Colors
):

  /** Parameters as of [[Film.toImage]]. */
  def apply(
      film: Film,
      weights: Option[Array[Float]] = None,
      isStopped: () => Boolean = GivenUp.Never,
      pool: Parallel = Parallel.Alone
  ): Image =
    val image = film.toImage(scale, weights, isStopped = isStopped, pool = pool)
    val data = image.data
    if sensor.isDefined || balance.isDefined then
      pool.ranges(image.width * image.height): (from, until) =>
        loop(until - from)(pixel => color(data, 3 * (from + pixel)))
    if clipsNegative then
      pool.ranges(data.length): (from, until) =>
        loop(until - from)(i => data(from + i) = Math.max(0f, data(from + i)))
    if space.isSrgb then image
    else Image(image.width, image.height, image.channelNames, image.data, colorSpace = space)

  /** Develops the colour at `at`, but for its scale. */
  def color(data: Array[Float], at: Int): Unit =
    for response <- sensor do response(data(at), data(at + 1), data(at + 2), data, at)
    for m <- balance do
      val r = data(at)
      val g = data(at + 1)
      val b = data(at + 2)
      loop(3)(c => data(at + c) = m(3 * c) * r + m(3 * c + 1) * g + m(3 * c + 2) * b)
