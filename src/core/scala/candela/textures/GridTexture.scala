package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*

/** Where a point lies in the unit cube of a grid. */
enum GridPlace:
  case InSpace(mapping: Mapping3D)

  /** At u and 1 − v, like an image. */
  case OfUv

  def apply(at: ShadingPoint): Vec3 = this match
    case InSpace(mapping) => mapping(at)
    case OfUv => Vec3(at.u, 1f - at.v, 0.5f)

/** Numbers of a grid over the unit cube; outside, those of its border. */
final class FloatGridTexture(mapping: GridPlace, grid: TrilinearGrid) extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    val p = mapping(at)
    grid(p.x, p.y, p.z)

/** Likewise, colours. */
final class RgbGridTexture(
    mapping: GridPlace,
    red: TrilinearGrid,
    green: TrilinearGrid,
    blue: TrilinearGrid
) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb =
    val p = mapping(at)
    Rgb(red(p.x, p.y, p.z), green(p.x, p.y, p.z), blue(p.x, p.y, p.z))
