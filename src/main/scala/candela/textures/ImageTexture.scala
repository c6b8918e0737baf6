package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint

/** A number from a picture: scale·v, or 1 − scale·v (not below 0) if `invert`. */
final class FloatImageTexture(
    mapping: Mapping2D,
    lookup: ImageLookup,
    scale: Float = 1f,
    invert: Boolean = false
) extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    ImageTexture.finish(lookup.value(mapping, at), scale, invert)

/** A colour from a picture, with `scale` and `invert` as for [[FloatImageTexture]]. */
final class RgbImageTexture(
    mapping: Mapping2D,
    lookup: ImageLookup,
    scale: Float = 1f,
    invert: Boolean = false
) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb =
    val color = lookup.color(mapping, at)
    if scale == 1f && !invert then color
    else color.map(v => ImageTexture.finish(v, scale, invert))

private object ImageTexture:
  def finish(value: Float, scale: Float, invert: Boolean): Float =
    val scaled = value * scale
    if invert then Math.max(0f, 1f - scaled) else scaled
