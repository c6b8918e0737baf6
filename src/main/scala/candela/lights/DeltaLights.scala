package candela.lights

import candela.color.Rgb
import candela.math.*

/** A point that sends `intensity` (W·sr⁻¹) in all directions. */
final class PointLight(position: Vec3, intensity: Rgb) extends Light:
  def isDelta: Boolean = true

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    val d = position - from
    val distance2 = d.lengthSquared
    out.wi = d * (1f / sqrt(distance2))
    out.radiance = intensity * (1f / distance2)
    out.pdf = if distance2 > 0f then 1f else 0f
    out.isInfinite = false
    out.target.p = position
    out.target.pError = Vec3.Zero
    out.target.n = Vec3.Zero

  def bounds: Option[LightBounds] =
    Some(LightBounds.everywhere(position, 4f * Pi * intensity.max))

/** Parallel light of `irradiance` on a plane facing it, that travels against `toLight` (unit). */
final class DistantLight(toLight: Vec3, irradiance: Rgb) extends Light:
  def isDelta: Boolean = true

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    out.wi = toLight
    out.radiance = irradiance
    out.pdf = 1f
    out.isInfinite = true

  def bounds: Option[LightBounds] = None
