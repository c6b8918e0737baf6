package candela.lights

import candela.color.Rgb
import candela.math.*

/** A point that shines, perhaps more into some directions than into others. */
abstract class PositionedLight(position: Vec3) extends Light:
  final def isDelta: Boolean = true

  /** In W·sr⁻¹, into the unit direction `w` of world space. */
  def intensity(w: Vec3): Rgb

  final def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    val d = position - from
    val distance2 = d.lengthSquared
    out.wi = d * (1f / sqrt(distance2))
    out.pdf = if distance2 > 0f then 1f else 0f
    out.radiance = if distance2 > 0f then intensity(-out.wi) * (1f / distance2) else Rgb.Black
    out.isInfinite = false
    out.target.p = position
    out.target.pError = Vec3.Zero
    out.target.n = Vec3.Zero

object PositionedLight:
  /** What the cosine of a cone's edge may be off by rounding: light there must not be missed. */
  private[lights] inline val Slack = 1e-4f

/** A point that sends `all` (W·sr⁻¹) in all directions. */
final class PointLight(position: Vec3, all: Rgb) extends PositionedLight(position):
  def intensity(w: Vec3): Rgb = all
  def bounds: Option[LightBounds] =
    Some(LightBounds.everywhere(position, 4f * Pi * all.max))

/** Parallel light of `irradiance` on a plane facing it, that travels against `toLight` (unit). */
final class DistantLight(toLight: Vec3, irradiance: Rgb) extends Light:
  def isDelta: Boolean = true

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    out.wi = toLight
    out.radiance = irradiance
    out.pdf = 1f
    out.isInfinite = true

  def bounds: Option[LightBounds] = None
