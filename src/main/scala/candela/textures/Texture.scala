package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*

/** What may differ from point to point of a surface. */
trait Varying:

  /** Is it the same everywhere? Then it is evaluated once, at build. */
  def isConstant: Boolean

  /** Does it depend on the direction along the surface? Then the tangent matters. */
  def isAnisotropic: Boolean = false

/** What is made of parts that may vary. */
trait Textured(parts: Varying*) extends Varying:
  override val isConstant: Boolean = parts.forall(_.isConstant)
  private val isDirected = parts.exists(_.isAnisotropic)
  override def isAnisotropic: Boolean = isDirected

/** A number at every point of a surface. */
abstract class FloatTexture extends Varying:
  final def isConstant: Boolean = constant.isDefined
  def apply(at: ShadingPoint): Float

  /** The value, if it is the same everywhere: lets the builder make constants of it. */
  def constant: Option[Float] = None

/** A colour at every point of a surface. */
abstract class RgbTexture extends Varying:
  final def isConstant: Boolean = constant.isDefined
  def apply(at: ShadingPoint): Rgb
  def constant: Option[Rgb] = None

  /** The colour, held to be at least 0. */
  final def positive(at: ShadingPoint): Rgb = apply(at).map(c => Math.max(c, 0f))

  /** The colour, held to [0, 1]. */
  final def albedo(at: ShadingPoint): Rgb = apply(at).map(c => clamp(c, 0f, 1f))

final class ConstantFloat(value: Float) extends FloatTexture:
  def apply(at: ShadingPoint): Float = value
  override def constant: Option[Float] = Some(value)

final class ConstantRgb(value: Rgb) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb = value
  override def constant: Option[Rgb] = Some(value)
