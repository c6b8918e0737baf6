package candela.lights

import candela.base.loop
import candela.color.Rgb
import candela.image.Image
import candela.math.*

/** An environment map: a colour per direction, from an image mapped to the sphere by `layout`.
  *
  * @param factor scale of the image's values
  * @param smooth whether lookups are bilinear (pbrt-v2, v3) or nearest-pixel (v4)
  * @param colors converts the image's colours, if they are not those of the scene's basis
  */
abstract class SphereImage(
    final val width: Int,
    final val height: Int,
    final val layout: SphereMap,
    factor: Rgb,
    final val smooth: Boolean,
    colors: Option[Rgb => Rgb]
):
  private val convert: (Rgb => Rgb) | Null = colors.orNull

  /** Colour in the unit direction `d` of light space. */
  final def apply(d: Vec3): Rgb = colorAt(layout.toImage(d))

  /** Colour at the image position (x, y, 0). */
  final def colorAt(place: Vec3): Rgb =
    if smooth then bilinear(place)
    else
      val x = Math.min((place.x * width).toInt, width - 1)
      converted(pixel(x, Math.min((place.y * height).toInt, height - 1)))

  private def converted(c: Rgb): Rgb =
    val conversion = convert
    if conversion == null then c else conversion(c) * factor

  /** Bilinear lookup, regardless of `smooth`. */
  final def bilinear(uv: Vec3): Rgb =
    converted(blended(uv.x * width - 0.5f, uv.y * height - 0.5f))

  /** Colour of a pixel of the image. */
  protected def pixel(x: Int, y: Int): Rgb

  /** Bilinear interpolation; (x, y) in pixels, from the first pixel's centre. */
  protected def blended(x: Float, y: Float): Rgb

  /** Column and row of the pixel that is at (x, y), which may be outside the image. */
  protected final def column(x: Int, y: Int): Int = layout.wrapX(x, y, width, height)
  protected final def row(x: Int, y: Int): Int = layout.wrapY(x, y, width, height)

  /** A number of each pixel, in row order. */
  def ofPixels(value: SphereImage.PixelValue): Array[Float]

  /** Whether a pixel shines that has an area. */
  def isLit: Boolean

  /** Mean brightness of lookups within each pixel, in row order. */
  final def brightness: Array[Float] =
    val means = ofPixels((r, g, b) => (r + g + b) * (1f / 3f))
    if !smooth then means
    else
      val blurred = new Array[Float](means.length)
      loop(height): y =>
        loop(width): x =>
          val isInside = x > 0 && y > 0 && x < width - 1 && y < height - 1
          var sum = 0f
          loop(9): k =>
            val i = x + k % 3 - 1
            val j = y + k / 3 - 1
            val index = if isInside then j * width + i else row(i, j) * width + column(i, j)
            sum += SphereImage.Tent(k) * means(index)
          blurred(y * width + x) = sum
      blurred

  /** Mean of the largest component over all directions. */
  final def meanOfMax: Float =
    val maxima = ofPixels((r, g, b) => Math.max(r, Math.max(g, b)))
    var sum = 0.0
    var weights = 0.0
    loop(height): y =>
      val share = layout.stretch((y + 0.5f) / height)
      loop(width): x =>
        sum += share * maxima(y * width + x)
        weights += share
    (sum / weights).toFloat

object SphereImage:
  trait PixelValue:
    def apply(r: Float, g: Float, b: Float): Float

  /** @param image red, green, blue, linear; for other parameters see the class */
  def apply(
      image: Image,
      layout: SphereMap,
      factor: Rgb,
      smooth: Boolean,
      colors: Option[Rgb => Rgb] = None
  ): SphereImage = MemorySphereImage(image, layout, factor, smooth, colors)

  /** Weights of a 3×3 neighbourhood in the mean of bilinear lookups within its centre pixel: the
    * products of 1/8, 3/4, 1/8.
    */
  private val Tent: Array[Float] =
    val side = Array(0.125f, 0.75f, 0.125f)
    Array.tabulate(9)(k => side(k % 3) * side(k / 3))

/** An image in memory. */
private final class MemorySphereImage(
    image: Image,
    layout: SphereMap,
    factor: Rgb,
    smooth: Boolean,
    colors: Option[Rgb => Rgb]
) extends SphereImage(image.width, image.height, layout, factor, smooth, colors):

  private val data: Array[Float] =
    if colors.isDefined || factor == Rgb.White then image.data
    else
      val d = image.data.clone()
      loop(width * height): i =>
        d(3 * i) *= factor.r
        d(3 * i + 1) *= factor.g
        d(3 * i + 2) *= factor.b
      d

  protected def pixel(x: Int, y: Int): Rgb =
    val first = 3 * (y * width + x)
    Rgb(data(first), data(first + 1), data(first + 2))

  protected def blended(x: Float, y: Float): Rgb =
    Bilinear(data, x, y)((i, j) => 3 * (row(i, j) * width + column(i, j)))

  def ofPixels(value: SphereImage.PixelValue): Array[Float] =
    val result = new Array[Float](Math.multiplyExact(width, height))
    loop(result.length): i =>
      result(i) = value(data(3 * i), data(3 * i + 1), data(3 * i + 2))
    result

  def isLit: Boolean =
    (0 until height).exists: y =>
      layout.stretch((y + 0.5f) / height) > 0f && {
        var i = 3 * y * width
        val end = i + 3 * width
        while i < end && !(data(i) > 0f) do i += 1
        i < end
      }
