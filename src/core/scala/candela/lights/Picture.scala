package candela.lights

import candela.base.loop
import candela.color.Rgb
import candela.image.Image
import candela.math.*
import candela.textures.Wrap

/** How a light's image is looked up.
  *
  * @param isSmooth bilinear; else the nearest pixel
  * @param wrap     outside the image
  */
final case class PictureLookup(isSmooth: Boolean, wrap: Wrap)

object PictureLookup:
  val Nearest: PictureLookup = PictureLookup(isSmooth = false, Wrap.Clamp)
  val Smooth: PictureLookup = PictureLookup(isSmooth = true, Wrap.Clamp)
  val SmoothRepeating: PictureLookup = PictureLookup(isSmooth = true, Wrap.Repeat)

/** A flat image emitted by a light; the image is (x, y) in [0, 1], y down from the top.
  *
  * @param image  red, green, blue, linear
  * @param colors converts the image's colours, if they are not those of the scene's basis
  */
final class Picture(image: Image, lookup: PictureLookup, colors: Option[Rgb => Rgb] = None):
  private val convert: (Rgb => Rgb) | Null = colors.orNull
  private val width = image.width
  private val height = image.height
  private val data = image.data

  val aspect: Float = width.toFloat / height

  def apply(x: Float, y: Float): Rgb =
    if !lookup.isSmooth then
      val i = pixel(Math.floor(x * width).toInt, Math.floor(y * height).toInt)
      converted(Rgb(data(i), data(i + 1), data(i + 2)))
    else
      val fx = x * width - 0.5f
      val fy = y * height - 0.5f
      converted(Bilinear(data, fx, fy)(pixel(_, _)))

  private def converted(c: Rgb): Rgb =
    val conversion = convert
    if conversion == null then c else conversion(c)

  /** The same image with converted colours. */
  def converted(colors: Rgb => Rgb): Picture = Picture(image, lookup, Some(colors))

  private def pixel(x: Int, y: Int): Int = 3 * lookup.wrap.index(x, y, width, height)

  /** Mean of the largest component. */
  lazy val meanOfMax: Float = mean((c, _, _) => c.max)

  /** Mean of `f` over the pixels' colours, weighted by their position (x, y). */
  def mean(f: (Rgb, Float, Float) => Float): Float =
    var sum = 0.0
    loop(height): y =>
      loop(width): x =>
        val i = pixel(x, y)
        sum += f(
          converted(Rgb(data(i), data(i + 1), data(i + 2))),
          (x + 0.5f) / width,
          (y + 0.5f) / height
        )
    (sum / (width.toDouble * height)).toFloat

/** Bilinear interpolation between the four nearest pixels. */
private[lights] object Bilinear:

  /** @param x, y  in pixels, from the first pixel's centre
    * @param pixel offset in `data` of the pixel (i, j), which may be outside the image
    */
  inline def apply(data: Array[Float], x: Float, y: Float)(inline pixel: (Int, Int) => Int): Rgb =
    val i = Math.floor(x).toInt
    val j = Math.floor(y).toInt
    val a = pixel(i, j)
    val b = pixel(i + 1, j)
    val c = pixel(i, j + 1)
    val d = pixel(i + 1, j + 1)
    Rgb(
      mix(data, a, b, c, d, x - i, y - j),
      mix(data, a + 1, b + 1, c + 1, d + 1, x - i, y - j),
      mix(data, a + 2, b + 2, c + 2, d + 2, x - i, y - j)
    )

  def mix(data: Array[Float], a: Int, b: Int, c: Int, d: Int, tx: Float, ty: Float): Float =
    lerp(ty, lerp(tx, data(a), data(b)), lerp(tx, data(c), data(d)))
