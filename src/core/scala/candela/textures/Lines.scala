package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint

/** Lines where s or t is an integer.
  *
  * @param reach half the width of a line
  */
final class Lines(mapping: Mapping2D, reach: Float):
  def isOnLine(at: ShadingPoint): Boolean =
    val c = mapping(at)
    distance(c.s) < reach || distance(c.t) < reach

  /** To the nearest integer. */
  private def distance(x: Float): Float =
    val fraction = x - Math.floor(x.toDouble).toFloat
    Math.min(fraction, 1f - fraction)

final class LinesFloat(lines: Lines, between: FloatTexture, along: FloatTexture)
    extends FloatTexture:
  def apply(at: ShadingPoint): Float = if lines.isOnLine(at) then along(at) else between(at)

final class LinesRgb(lines: Lines, between: RgbTexture, along: RgbTexture) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb = if lines.isOnLine(at) then along(at) else between(at)
  override def maximum: Rgb = between.maximum.atLeast(along.maximum)
