package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.TrilinearGrid

/** Numbers of a grid over the unit cube of texture space; outside, those of its border. */
final class FloatGridTexture(mapping: Mapping3D, grid: TrilinearGrid) extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    val p = mapping(at)
    grid(p.x, p.y, p.z)

/** Likewise, colours. */
final class RgbGridTexture(
    mapping: Mapping3D,
    red: TrilinearGrid,
    green: TrilinearGrid,
    blue: TrilinearGrid
) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb =
    val p = mapping(at)
    Rgb(red(p.x, p.y, p.z), green(p.x, p.y, p.z), blue(p.x, p.y, p.z))
