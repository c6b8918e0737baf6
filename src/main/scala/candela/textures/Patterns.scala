package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.lerp

/** Unit squares of `even` and `odd` in turn; the one from (0, 0) to (1, 1) is even. Not filtered:
  * its edges are smoothed by the pixel's samples.
  */
final class CheckerboardFloat(mapping: Mapping2D, even: FloatTexture, odd: FloatTexture)
    extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    if Checkerboard.isEven(mapping(at)) then even(at) else odd(at)

/** Unit squares of `even` and `odd` in turn, as [[CheckerboardFloat]]. */
final class CheckerboardRgb(mapping: Mapping2D, even: RgbTexture, odd: RgbTexture)
    extends RgbTexture:
  def apply(at: ShadingPoint): Rgb =
    if Checkerboard.isEven(mapping(at)) then even(at) else odd(at)

private object Checkerboard:
  def isEven(c: TexCoord): Boolean =
    ((Math.floor(c.s.toDouble).toLong + Math.floor(c.t.toDouble).toLong) & 1) == 0

/** Bilinear between four corners, `v10` being that at s = 1, t = 0; goes on linearly outside. */
final class BilerpFloat(mapping: Mapping2D, v00: Float, v01: Float, v10: Float, v11: Float)
    extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    val c = mapping(at)
    lerp(c.t, lerp(c.s, v00, v10), lerp(c.s, v01, v11))

/** Bilinear between four corners, as [[BilerpFloat]]. */
final class BilerpRgb(mapping: Mapping2D, v00: Rgb, v01: Rgb, v10: Rgb, v11: Rgb)
    extends RgbTexture:
  def apply(at: ShadingPoint): Rgb =
    val c = mapping(at)
    (v00 * (1f - c.s) + v10 * c.s) * (1f - c.t) + (v01 * (1f - c.s) + v11 * c.s) * c.t
