package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.lerp

/** How an image is read between its texels. */
enum TextureFilter:
  /** The texel that the point lies in. */
  case Point

  /** The four nearest, linearly. */
  case Bilinear

  /** Filters over pixel footprints. Without a pyramid of images they read like `Bilinear`: right on
    * average, but in need of more samples where many texels share a pixel.
    */
  case Trilinear, Ewa

/** Looks up texels at places of the unit square: s to the right, and t up from the picture's last
  * row if `bottomUp`, as in pbrt-v3 and v4 (and v2 for TGA files), else down from its first (v2,
  * EXR). Texel centres lie at half-integer multiples of the texel size.
  */
final class ImageLookup(texels: Texels, wrap: Wrap, filter: TextureFilter, bottomUp: Boolean):
  private val width = texels.width
  private val height = texels.height
  private val isPoint = filter == TextureFilter.Point

  def value(at: TexCoord): Float =
    if isPoint then texel(pointIndex(at), 0) else bilinear(at, 0)

  def color(at: TexCoord): Rgb =
    if texels.channels == 1 then Rgb.gray(value(at))
    else if isPoint then
      val index = pointIndex(at)
      Rgb(texel(index, 0), texel(index, 1), texel(index, 2))
    else
      val x = at.s * width - 0.5f
      val y = row(at) - 0.5f
      val x0 = floor(x)
      val y0 = floor(y)
      val dx = x - x0
      val dy = y - y0
      val i00 = wrap.index(x0, y0, width, height)
      val i10 = wrap.index(x0 + 1, y0, width, height)
      val i01 = wrap.index(x0, y0 + 1, width, height)
      val i11 = wrap.index(x0 + 1, y0 + 1, width, height)
      Rgb(
        blend(i00, i10, i01, i11, 0, dx, dy),
        blend(i00, i10, i01, i11, 1, dx, dy),
        blend(i00, i10, i01, i11, 2, dx, dy)
      )

  private def bilinear(at: TexCoord, channel: Int): Float =
    val x = at.s * width - 0.5f
    val y = row(at) - 0.5f
    val x0 = floor(x)
    val y0 = floor(y)
    blend(
      wrap.index(x0, y0, width, height),
      wrap.index(x0 + 1, y0, width, height),
      wrap.index(x0, y0 + 1, width, height),
      wrap.index(x0 + 1, y0 + 1, width, height),
      channel,
      x - x0,
      y - y0
    )

  private def blend(i00: Int, i10: Int, i01: Int, i11: Int, c: Int, dx: Float, dy: Float): Float =
    lerp(dy, lerp(dx, texel(i00, c), texel(i10, c)), lerp(dx, texel(i01, c), texel(i11, c)))

  private def texel(index: Int, channel: Int): Float =
    if index < 0 then 0f else texels(index, channel)

  private def pointIndex(at: TexCoord): Int =
    wrap.index(floor(at.s * width), floor(row(at)), width, height)

  /** Distance from the picture's upper edge, in texels. */
  private def row(at: TexCoord): Float = (if bottomUp then 1f - at.t else at.t) * height

  private def floor(x: Float): Int =
    val truncated = x.toInt
    if truncated > x then truncated - 1 else truncated

/** A number from a picture: scale·v, or 1 − scale·v (not below 0) if `invert`. */
final class FloatImageTexture(
    mapping: Mapping2D,
    lookup: ImageLookup,
    scale: Float = 1f,
    invert: Boolean = false
) extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    ImageTexture.finish(lookup.value(mapping(at)), scale, invert)

/** A colour from a picture, with `scale` and `invert` as for [[FloatImageTexture]]. */
final class RgbImageTexture(
    mapping: Mapping2D,
    lookup: ImageLookup,
    scale: Float = 1f,
    invert: Boolean = false
) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb =
    val color = lookup.color(mapping(at))
    if scale == 1f && !invert then color
    else color.map(v => ImageTexture.finish(v, scale, invert))

private object ImageTexture:
  def finish(value: Float, scale: Float, invert: Boolean): Float =
    val scaled = value * scale
    if invert then Math.max(0f, 1f - scaled) else scaled
