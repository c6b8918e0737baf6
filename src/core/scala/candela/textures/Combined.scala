package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.lerp

/** Product of two numbers. The `of` methods of combined textures return the simplest exact
  * specialisation: combinations of constants become constants. A texture that is given twice is
  * evaluated once: chains of such would take exponential time.
  */
final class ScaledFloat private (a: FloatTexture, b: FloatTexture) extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    val x = a(at)
    x * (if b eq a then x else b(at))

object ScaledFloat:
  def of(a: FloatTexture, b: FloatTexture): FloatTexture = (a.constant, b.constant) match
    case (Some(x), Some(y)) => ConstantFloat(x * y)
    case (Some(1f), _) => b
    case (_, Some(1f)) => a
    case _ => ScaledFloat(a, b)

/** Product of two colours (pbrt-v2, v3). */
final class ProductRgb private (a: RgbTexture, b: RgbTexture) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb =
    val x = a(at)
    x * (if b eq a then x else b(at))
  override def maximum: Rgb = a.maximum * b.maximum

object ProductRgb:
  def of(a: RgbTexture, b: RgbTexture): RgbTexture = (a.constant, b.constant) match
    case (Some(x), Some(y)) => ConstantRgb(x * y)
    case (Some(Rgb.White), _) => b
    case (_, Some(Rgb.White)) => a
    case _ => ProductRgb(a, b)

/** A colour scaled by a number (pbrt-v4). */
final class ScaledRgb private (a: RgbTexture, scale: FloatTexture) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb = a(at) * scale(at)
  override def maximum: Rgb = a.maximum * scale.constant.getOrElse(1f)

object ScaledRgb:
  def of(a: RgbTexture, scale: FloatTexture): RgbTexture = (a.constant, scale.constant) match
    case (Some(x), Some(s)) => ConstantRgb(x * s)
    case (_, Some(1f)) => a
    case _ => ScaledRgb(a, scale)

/** (1 − amount)·a + amount·b. */
final class MixFloat private (a: FloatTexture, b: FloatTexture, amount: FloatTexture)
    extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    val x = a(at)
    val y = if b eq a then x else b(at)
    lerp(if amount eq a then x else if amount eq b then y else amount(at), x, y)

object MixFloat:
  def of(a: FloatTexture, b: FloatTexture, amount: FloatTexture): FloatTexture =
    (a.constant, b.constant, amount.constant) match
      case (_, _, Some(0f)) => a
      case (_, _, Some(1f)) => b
      case (Some(x), Some(y), Some(t)) => ConstantFloat(lerp(t, x, y))
      case _ => MixFloat(a, b, amount)

/** (1 − amount)·a + amount·b. */
final class MixRgb private (a: RgbTexture, b: RgbTexture, amount: FloatTexture) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb =
    val x = a(at)
    MixRgb.mix(amount(at), x, if b eq a then x else b(at))

object MixRgb:
  def of(a: RgbTexture, b: RgbTexture, amount: FloatTexture): RgbTexture =
    (a.constant, b.constant, amount.constant) match
      case (_, _, Some(0f)) => a
      case (_, _, Some(1f)) => b
      case (Some(x), Some(y), Some(t)) => ConstantRgb(mix(t, x, y))
      case _ => MixRgb(a, b, amount)

  private def mix(t: Float, a: Rgb, b: Rgb): Rgb = a * (1f - t) + b * t

/** A texture of linear sRGB colours, converted to another basis. */
final class RebasedTexture(texture: RgbTexture, convert: Rgb => Rgb) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb = convert(texture(at))
  override def maximum: Rgb = texture.maximum

/** 1 where a texture is at least `from`, else 0. */
final class StepFloat private (texture: FloatTexture, from: Float) extends FloatTexture:
  def apply(at: ShadingPoint): Float = if texture(at) >= from then 1f else 0f

object StepFloat:
  def of(texture: FloatTexture, from: Float): FloatTexture = texture.constant match
    case Some(x) => ConstantFloat(if x >= from then 1f else 0f)
    case None => new StepFloat(texture, from)

/** The colour of the vertices of a mesh. */
object VertexRgb extends RgbTexture:
  def apply(at: ShadingPoint): Rgb = Rgb(at.red, at.green, at.blue)

/** Their alpha. */
object VertexAlpha extends FloatTexture:
  def apply(at: ShadingPoint): Float = at.alpha
