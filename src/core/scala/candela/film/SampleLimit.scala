package candela.film

import candela.color.{Colorimetry, Matrix3, Rgb}

/** Clamps the brightness of samples; brighter ones are scaled down, preserving their colour.
  *
  * @param maximum maximum of any of the measures
  * @param weights of linear red, green and blue in each measure, three numbers each
  */
final class SampleLimit(val maximum: Float, weights: Array[Float]):

  /** Scale of a sample: 1 if it is within the limit. */
  def scale(c: Rgb): Float =
    var brightest = 0f
    var i = 0
    while i < weights.length do
      val value = weights(i) * c.r + weights(i + 1) * c.g + weights(i + 2) * c.b
      if value > brightest then brightest = value
      i += 3
    if brightest > maximum then maximum / brightest else 1f

object SampleLimit:

  /** Limits the luminance, as in pbrt-v3; none if `maximum` is infinite. */
  def luminance(maximum: Float): Option[SampleLimit] =
    limit(maximum, Colorimetry.XyzOfRgb.slice(3, 6))

  /** Limits the largest of X, Y and Z, the channels of pbrt-v4's standard sensor. */
  def sensor(maximum: Float): Option[SampleLimit] = limit(maximum, Colorimetry.XyzOfRgb)

  /** Limits the largest channel of a camera sensor.
    *
    * @param toSrgb 3 × 3 matrix, row by row, from sensor values to linear sRGB; its inverse
    *               approximates the sensor's response to a colour
    */
  def camera(maximum: Float, toSrgb: Array[Float]): Option[SampleLimit] =
    limit(maximum, Matrix3(toSrgb.map(_.toDouble).toVector).inverse.toFloats)

  /** Limits the largest of three channels. */
  def channels(maximum: Float): Option[SampleLimit] =
    limit(maximum, Array(1f, 0f, 0f, 0f, 1f, 0f, 0f, 0f, 1f))

  private def limit(maximum: Float, weights: Array[Float]): Option[SampleLimit] =
    Option.when(maximum < Float.PositiveInfinity)(SampleLimit(maximum, weights))
