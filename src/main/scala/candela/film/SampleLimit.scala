package candela.film

import candela.color.{Colorimetry, Matrix3, Rgb}

/** The brightest that a sample may be; what is brighter is scaled down, and keeps its colour.
  *
  * @param most    of any of the measures
  * @param weights of linear red, green and blue in each measure, three numbers each
  */
final class SampleLimit(val most: Float, weights: Array[Float]):

  /** By what to multiply a sample: 1 if it is within the limit. */
  def scale(c: Rgb): Float =
    var brightest = 0f
    var i = 0
    while i < weights.length do
      val value = weights(i) * c.r + weights(i + 1) * c.g + weights(i + 2) * c.b
      if value > brightest then brightest = value
      i += 3
    if brightest > most then most / brightest else 1f

object SampleLimit:

  /** Of the luminance, as in pbrt-v3; none if it is no limit. */
  def luminance(most: Float): Option[SampleLimit] =
    limit(most, Colorimetry.XyzOfRgb.slice(3, 6))

  /** Of the largest of X, Y and Z, the components that pbrt-v4's standard sensor has. */
  def sensor(most: Float): Option[SampleLimit] = limit(most, Colorimetry.XyzOfRgb)

  /** Of the largest of what a camera's cells make of light.
    *
    * @param toSrgb nine numbers, row by row: the map of that to linear sRGB, whose inverse stands
    *               for what the cells make of a colour
    */
  def camera(most: Float, toSrgb: Array[Float]): Option[SampleLimit] =
    limit(most, Matrix3(toSrgb.map(_.toDouble).toVector).inverse.toFloats)

  private def limit(most: Float, weights: Array[Float]): Option[SampleLimit] =
    Option.when(most < Float.PositiveInfinity)(SampleLimit(most, weights))
