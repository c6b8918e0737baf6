package candela.textures

import candela.color.{MutableRgb, Rgb}
import candela.math.*

/** Reads texels of a level by their index. */
trait TexelReader:
  def apply(index: Int, channel: Int): Float

/** One level of a MIP map. Positions are in the unit square, the second coordinate down from the
  * image's upper edge; texel centres are at half-integer multiples of the texel size.
  */
abstract class MipLevel(final val width: Int, final val height: Int, final val isGray: Boolean)
    extends TexelReader:

  /** Where the texel (`x`, `y`) is for `apply`, after wrapping; negative for black. */
  def index(x: Int, y: Int): Int

  /** Width and height of the parts that are best read one after the other. */
  def tile: (Int, Int) = (width, height)

  /** For many texels that are near each other; not safe for threads. */
  def reader: TexelReader = this

  /** All of a texel, by its index. */
  def texel(index: Int): Rgb =
    if isGray then Rgb.gray(apply(index, 0))
    else Rgb(apply(index, 0), apply(index, 1), apply(index, 2))

  /** The texel that contains the point. */
  final def nearest(s: Float, row: Float): Rgb =
    texel(index(MipLevel.floor(s * width), MipLevel.floor(row * height)))

  final def addNearest(s: Float, row: Float, sum: MutableRgb): Unit = sum.add(nearest(s, row))

  /** Bilinear interpolation of the four nearest texels. */
  final def bilinear(s: Float, row: Float): Rgb =
    val sum = MutableRgb()
    addBilinear(s, row, 1f, sum)
    sum.toRgb

  /** Adds [[bilinear]] times `weight` to `sum`. */
  def addBilinear(s: Float, row: Float, weight: Float, sum: MutableRgb): Unit =
    val x = MipLevel.clampCoordinate(s * width - 0.5f)
    val y = MipLevel.clampCoordinate(row * height - 0.5f)
    val x0 = MipLevel.floor(x)
    val y0 = MipLevel.floor(y)
    val dx = x - x0
    val dy = y - y0
    val i00 = index(x0, y0)
    val i10 = index(x0 + 1, y0)
    val i01 = index(x0, y0 + 1)
    val i11 = index(x0 + 1, y0 + 1)
    val r = weight * blend(i00, i10, i01, i11, 0, dx, dy)
    if isGray then sum.add(r, r, r)
    else
      val g = weight * blend(i00, i10, i01, i11, 1, dx, dy)
      sum.add(r, g, weight * blend(i00, i10, i01, i11, 2, dx, dy))

  /** Derivatives of the first channel of [[bilinear]], by `s` and `row`. */
  def slopes(s: Float, row: Float): Slopes =
    val x = MipLevel.clampCoordinate(s * width - 0.5f)
    val y = MipLevel.clampCoordinate(row * height - 0.5f)
    val x0 = MipLevel.floor(x)
    val y0 = MipLevel.floor(y)
    val v00 = apply(index(x0, y0), 0)
    val v10 = apply(index(x0 + 1, y0), 0)
    val v01 = apply(index(x0, y0 + 1), 0)
    val v11 = apply(index(x0 + 1, y0 + 1), 0)
    Slopes(lerp(y - y0, v10 - v00, v11 - v01) * width, lerp(x - x0, v01 - v00, v11 - v10) * height)

  private def blend(i00: Int, i10: Int, i01: Int, i11: Int, c: Int, dx: Float, dy: Float): Float =
    lerp(dy, lerp(dx, apply(i00, c), apply(i10, c)), lerp(dx, apply(i01, c), apply(i11, c)))

/** A level in memory. */
private final class TexelLevel(texels: Texels, wrap: Wrap)
    extends MipLevel(texels.width, texels.height, texels.channels == 1):
  def index(x: Int, y: Int): Int = wrap.index(x, y, width, height)
  def apply(index: Int, channel: Int): Float = if index < 0 then 0f else texels(index, channel)

object MipLevel:
  def apply(texels: Texels, wrap: Wrap): MipLevel = TexelLevel(texels, wrap)

  /** Texels farther out than this have no numbers that one can count on from. */
  private val MaxCoordinate = 1e9f

  /** A place in texels, brought to where they have numbers; 0 for NaN. */
  private[textures] def clampCoordinate(x: Float): Float =
    if x >= -MaxCoordinate && x <= MaxCoordinate then x
    else if x > MaxCoordinate then MaxCoordinate
    else if x < -MaxCoordinate then -MaxCoordinate
    else 0f

  private[textures] def floor(x: Float): Int =
    val truncated = x.toInt
    if truncated > x then truncated - 1 else truncated
