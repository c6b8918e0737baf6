package candela.film

import candela.color.{Colorimetry, Matrix3, Rgb}

/** Clamps the brightness of samples; brighter ones are scaled down, preserving their colour.
  *
  * @param most    maximum of any of the measures
  * @param weights of linear red, green and blue in each measure, three numbers each
  */
final class SampleLimit(val most: Float, weights: Array[Float]):

  /** Scale of a sample: 1 if it is within the limit. */
  def scale(c: Rgb): Float =
    var brightest = 0f
    var i = 0
    while i < weights.length do
      val value = weights(i) * c.r + weights(i + 1) * c.g + weights(i + 2) * c.b
      if value > brightest then brightest = value
      i += 3
    if brightest > most then most / brightest else 1f

object SampleLimit:

  /** Limits the luminance, as in pbrt-v3; none if `most` is infinite. */
  def luminance(most: Float): Option[SampleLimit] =
    limit(most, Colorimetry.XyzOfRgb.slice(3, 6))

  /** Limits the largest of X, Y and Z, the channels of pbrt-v4's standard sensor. */
  def sensor(most: Float): Option[SampleLimit] = limit(most, Colorimetry.XyzOfRgb)

  /** Limits the largest channel of a camera sensor.
    *
    * @param toSrgb 3 × 3 matrix, row by row, from sensor values to linear sRGB; its inverse
    *               approximates the sensor's response to a colour
    */
  def camera(most: Float, toSrgb: Array[Float]): Option[SampleLimit] =
    limit(most, Matrix3(toSrgb.map(_.toDouble).toVector).inverse.toFloats)

  /** Limits the largest of three channels. */
  def channels(most: Float): Option[SampleLimit] =
    limit(most, Array(1f, 0f, 0f, 0f, 1f, 0f, 0f, 0f, 1f))

  private def limit(most: Float, weights: Array[Float]): Option[SampleLimit] =
    Option.when(most < Float.PositiveInfinity)(SampleLimit(most, weights))
