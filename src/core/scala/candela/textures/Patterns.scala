package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*

/** Bilinear interpolation between four corners, with `v10` at s = 1, t = 0; extrapolates linearly.
  */
final class BilerpFloat(mapping: Mapping2D, v00: Float, v01: Float, v10: Float, v11: Float)
    extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    val c = mapping(at)
    lerp(c.t, lerp(c.s, v00, v10), lerp(c.s, v01, v11))

/** Bilinear interpolation between four corners, as [[BilerpFloat]]. */
final class BilerpRgb(mapping: Mapping2D, v00: Rgb, v01: Rgb, v10: Rgb, v11: Rgb)
    extends RgbTexture:
  def apply(at: ShadingPoint): Rgb =
    val c = mapping(at)
    (v00 * (1f - c.s) + v10 * c.s) * (1f - c.t) + (v01 * (1f - c.s) + v11 * c.s) * c.t

/** Polka dots in randomly selected unit squares around the integer points, at random offsets.
  *
  * Source: PBRT 3rd ed., §10.5.2.
  */
final class DotsFloat(mapping: Mapping2D, dot: FloatTexture, ground: FloatTexture)
    extends FloatTexture:
  def apply(at: ShadingPoint): Float = if Dots.isInside(mapping(at)) then dot(at) else ground(at)

/** Polka dots, as [[DotsFloat]]. */
final class DotsRgb(mapping: Mapping2D, dot: RgbTexture, ground: RgbTexture) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb = if Dots.isInside(mapping(at)) then dot(at) else ground(at)

private object Dots:
  private val Radius = 0.35f
  private val MaxShift = 0.5f - Radius

  def isInside(c: TexCoord): Boolean =
    val s = Math.floor(c.s + 0.5).toFloat
    val t = Math.floor(c.t + 0.5).toFloat
    PerlinNoise(s + 0.5f, t + 0.5f) > 0f && {
      val ds = c.s - (s + MaxShift * PerlinNoise(s + 1.5f, t + 2.8f))
      val dt = c.t - (t + MaxShift * PerlinNoise(s + 4.5f, t + 9.8f))
      ds * ds + dt * dt < Radius * Radius
    }

/** Texture coordinates as red and green, to visualise a parameterisation. */
final class UvColor(mapping: Mapping2D) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb =
    val c = mapping(at)
    Rgb(c.s - Math.floor(c.s.toDouble).toFloat, c.t - Math.floor(c.t.toDouble).toFloat, 0f)

/** Interpolates from `across` to `along` by |n·direction|, for the geometric normal n. */
final class DirectionMixFloat(along: FloatTexture, across: FloatTexture, direction: Vec3)
    extends FloatTexture:
  def apply(at: ShadingPoint): Float =
    val x = across(at)
    lerp(at.geometricNormal absDot direction, x, if along eq across then x else along(at))

/** Interpolates from `across` to `along` by |n·direction|, for the geometric normal n. */
final class DirectionMixRgb(along: RgbTexture, across: RgbTexture, direction: Vec3)
    extends RgbTexture:
  def apply(at: ShadingPoint): Rgb =
    val amount = at.geometricNormal absDot direction
    val x = along(at)
    x * amount + (if across eq along then x else across(at)) * (1f - amount)

/** A number as a grey colour. */
final class GrayTexture(value: FloatTexture) extends RgbTexture:
  def apply(at: ShadingPoint): Rgb = Rgb.gray(value(at))
  override def constant: Option[Rgb] = value.constant.map(Rgb.gray)
