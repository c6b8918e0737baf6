package candela.textures

import candela.color.Rgb
import candela.math.lerp

/** One picture of a pyramid, read between its texels. Places are given in the unit square, the
  * second coordinate down from the picture's upper edge; texel centres lie at half-integer
  * multiples of the texel size.
  */
final class MipLevel(private[textures] val texels: Texels, wrap: Wrap):
  val width: Int = texels.width
  val height: Int = texels.height
  val isGray: Boolean = texels.channels == 1

  /** Where the texel (`x`, `y`) is for `apply`, counted over the wrapped plane; −1: black. */
  def index(x: Int, y: Int): Int = wrap.index(x, y, width, height)

  def apply(index: Int, channel: Int): Float = if index < 0 then 0f else texels(index, channel)

  /** The texel that the point lies in. */
  def nearest(s: Float, row: Float): Rgb =
    val i = index(MipLevel.floor(s * width), MipLevel.floor(row * height))
    if isGray then Rgb.gray(apply(i, 0)) else Rgb(apply(i, 0), apply(i, 1), apply(i, 2))

  /** The four nearest, linearly. */
  def bilinear(s: Float, row: Float): Rgb =
    val x = s * width - 0.5f
    val y = row * height - 0.5f
    val x0 = MipLevel.floor(x)
    val y0 = MipLevel.floor(y)
    val dx = x - x0
    val dy = y - y0
    val i00 = index(x0, y0)
    val i10 = index(x0 + 1, y0)
    val i01 = index(x0, y0 + 1)
    val i11 = index(x0 + 1, y0 + 1)
    if isGray then Rgb.gray(blend(i00, i10, i01, i11, 0, dx, dy))
    else
      Rgb(
        blend(i00, i10, i01, i11, 0, dx, dy),
        blend(i00, i10, i01, i11, 1, dx, dy),
        blend(i00, i10, i01, i11, 2, dx, dy)
      )

  private def blend(i00: Int, i10: Int, i01: Int, i11: Int, c: Int, dx: Float, dy: Float): Float =
    lerp(dy, lerp(dx, apply(i00, c), apply(i10, c)), lerp(dx, apply(i01, c), apply(i11, c)))

object MipLevel:
  private[textures] def floor(x: Float): Int =
    val truncated = x.toInt
    if truncated > x then truncated - 1 else truncated
