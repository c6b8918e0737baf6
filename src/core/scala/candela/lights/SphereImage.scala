package candela.lights

import candela.base.loop
import candela.color.Rgb
import candela.image.Image
import candela.math.*

/** An environment map: a colour per direction, from an image mapped to the sphere by `layout`.
  *
  * @param image  red, green, blue, linear
  * @param factor scale of the image's values
  * @param smooth whether lookups are bilinear (pbrt-v2, v3) or nearest-pixel (v4)
  * @param colors converts the image's colours, if they are not those of the scene's basis
  */
final class SphereImage(
    image: Image,
    val layout: SphereMap,
    factor: Rgb,
    val smooth: Boolean,
    colors: Option[Rgb => Rgb] = None
):
  val width: Int = image.width
  val height: Int = image.height

  private val convert: (Rgb => Rgb) | Null = colors.orNull

  private val data: Array[Float] =
    if colors.isDefined then image.data
    else
      val d = image.data.clone()
      loop(width * height): i =>
        d(3 * i) *= factor.r
        d(3 * i + 1) *= factor.g
        d(3 * i + 2) *= factor.b
      d

  /** Colour in the unit direction `d` of light space. */
  def apply(d: Vec3): Rgb = at(layout.toImage(d))

  /** Colour at the image position (x, y, 0). */
  def at(place: Vec3): Rgb =
    if smooth then between(place)
    else
      val x = Math.min((place.x * width).toInt, width - 1)
      val first = 3 * (Math.min((place.y * height).toInt, height - 1) * width + x)
      converted(Rgb(data(first), data(first + 1), data(first + 2)))

  private def converted(c: Rgb): Rgb =
    val conversion = convert
    if conversion == null then c else conversion(c) * factor

  /** Bilinear lookup, regardless of `smooth`. */
  def between(place: Vec3): Rgb =
    val fx = place.x * width - 0.5f
    val fy = place.y * height - 0.5f
    converted(Bilinear(data, fx, fy)(pixel))

  private def pixel(x: Int, y: Int): Int =
    3 * (layout.wrapY(x, y, width, height) * width + layout.wrapX(x, y, width, height))

  /** Mean brightness of lookups within the pixel. */
  def brightness(x: Int, y: Int): Float =
    if !smooth then brightness(pixel(x, y))
    else
      val isInside = x > 0 && y > 0 && x < width - 1 && y < height - 1
      var sum = 0f
      loop(9): k =>
        val i = x + k % 3 - 1
        val j = y + k / 3 - 1
        val at = if isInside then 3 * (j * width + i) else pixel(i, j)
        sum += SphereImage.Tent(k) * brightness(at)
      sum

  private def brightness(at: Int): Float = (data(at) + data(at + 1) + data(at + 2)) * (1f / 3f)

  /** Mean of the largest component over all directions. */
  def meanOfMax: Float =
    var sum = 0.0
    var weights = 0.0
    loop(height): y =>
      val share = layout.stretch((y + 0.5f) / height)
      loop(width): x =>
        val i = 3 * (y * width + x)
        sum += share * Math.max(data(i), Math.max(data(i + 1), data(i + 2)))
        weights += share
    (sum / weights).toFloat

object SphereImage:
  /** Weights of a 3×3 neighbourhood in the mean of bilinear lookups within its centre pixel: the
    * products of 1/8, 3/4, 1/8.
    */
  private val Tent: Array[Float] =
    val side = Array(0.125f, 0.75f, 0.125f)
    Array.tabulate(9)(k => side(k % 3) * side(k / 3))
