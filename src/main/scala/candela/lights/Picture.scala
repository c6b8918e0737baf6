package candela.lights

import candela.base.loop
import candela.color.Rgb
import candela.image.Image
import candela.math.*

/** What lights look up in a flat image. */
enum PictureLookup:
  /** The pixel's colour. */
  case Nearest

  /** Bilinear between pixel centres; beyond the border the border goes on. */
  case Smooth

  /** Bilinear; beyond the border the other side follows. */
  case SmoothRepeating

/** A flat image that a light shows; (x, y) in [0, 1], y down from its top.
  *
  * @param image red, green, blue, linear
  */
final class Picture(image: Image, lookup: PictureLookup):
  private val width = image.width
  private val height = image.height
  private val data = image.data

  val aspect: Float = width.toFloat / height

  def apply(x: Float, y: Float): Rgb =
    if lookup == PictureLookup.Nearest then
      val i =
        pixel(clamp((x * width).toInt, 0, width - 1), clamp((y * height).toInt, 0, height - 1))
      Rgb(data(i), data(i + 1), data(i + 2))
    else
      val fx = x * width - 0.5f
      val fy = y * height - 0.5f
      val i = Math.floor(fx).toInt
      val j = Math.floor(fy).toInt
      val tx = fx - i
      val ty = fy - j
      val x0 = wrapped(i, width)
      val x1 = wrapped(i + 1, width)
      val y0 = wrapped(j, height)
      val y1 = wrapped(j + 1, height)
      val a = pixel(x0, y0)
      val b = pixel(x1, y0)
      val c = pixel(x0, y1)
      val d = pixel(x1, y1)
      def mix(k: Int): Float =
        lerp(ty, lerp(tx, data(a + k), data(b + k)), lerp(tx, data(c + k), data(d + k)))
      Rgb(mix(0), mix(1), mix(2))

  private def pixel(x: Int, y: Int): Int = 3 * (y * width + x)

  private def wrapped(i: Int, size: Int): Int =
    if lookup == PictureLookup.SmoothRepeating then Math.floorMod(i, size)
    else clamp(i, 0, size - 1)

  /** Mean over the pixels of `f` of their colour, weighted by their place (x, y). */
  def mean(f: (Rgb, Float, Float) => Float): Float =
    var sum = 0.0
    loop(height): y =>
      loop(width): x =>
        val i = pixel(x, y)
        sum += f(
          Rgb(data(i), data(i + 1), data(i + 2)),
          (x + 0.5f) / width,
          (y + 0.5f) / height
        )
    (sum / (width.toDouble * height)).toFloat
