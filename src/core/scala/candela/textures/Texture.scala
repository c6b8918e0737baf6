package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*

/** A quantity that may vary over a surface. */
trait Varying:

  /** Whether it is the same everywhere, and is evaluated once, at scene construction. */
  def isConstant: Boolean

  /** Whether it depends on the direction along the surface, and needs the tangent. */
  def isAnisotropic: Boolean = false

  /** Whether it tells that direction from the opposite one. */
  def isDirected: Boolean = false

/** A quantity composed of parts that may vary. */
trait Textured(parts: Varying*) extends Varying:
  override val isConstant: Boolean = parts.forall(_.isConstant)
  private val isAnyAnisotropic = parts.exists(_.isAnisotropic)
  private val isAnyDirected = parts.exists(_.isDirected)
  override def isAnisotropic: Boolean = isAnyAnisotropic
  override def isDirected: Boolean = isAnyDirected

/** A number at every surface point. */
abstract class FloatTexture extends Varying:
  final def isConstant: Boolean = constant.isDefined
  def apply(at: ShadingPoint): Float

  /** Derivatives by u and v, of textures that know them exactly. */
  def slopes(at: ShadingPoint): Slopes | Null = null

  /** The value if it is the same everywhere; scene construction folds it into constants. */
  def constant: Option[Float] = None

/** Derivatives of a number over a surface, by its parameters. */
final class Slopes(val byU: Float, val byV: Float)

/** A colour at every surface point. */
abstract class RgbTexture extends Varying:
  final def isConstant: Boolean = constant.isDefined
  def apply(at: ShadingPoint): Rgb
  def constant: Option[Rgb] = None

  /** An upper limit of each component; 1 of textures that know none. */
  def maximum: Rgb = constant.getOrElse(Rgb.White)

  /** The colour, clamped to at least 0. */
  final def positive(at: ShadingPoint): Rgb = apply(at).map(c => Math.max(c, 0f))

  /** The colour, clamped to [0, 1]. */
  final def albedo(at: ShadingPoint): Rgb = apply(at).map(c => clamp(c, 0f, 1f))

final class ConstantFloat(value: Float) extends FloatTexture:
  def apply(at: ShadingPoint): Float = value
  override def constant: Option[Float] = Some(value)

final class ConstantRgb(value: Rgb) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb = value
  override def constant: Option[Rgb] = Some(value)
