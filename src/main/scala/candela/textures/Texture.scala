package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint

/** A number at every point of a surface. */
abstract class FloatTexture:
  def apply(at: ShadingPoint): Float

  /** The value, if it is the same everywhere: lets the builder make constants of it. */
  def constant: Option[Float] = None

/** A colour at every point of a surface. */
abstract class RgbTexture:
  def apply(at: ShadingPoint): Rgb
  def constant: Option[Rgb] = None

final class ConstantFloat(value: Float) extends FloatTexture:
  def apply(at: ShadingPoint): Float = value
  override def constant: Option[Float] = Some(value)

final class ConstantRgb(value: Rgb) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb = value
  override def constant: Option[Rgb] = Some(value)
