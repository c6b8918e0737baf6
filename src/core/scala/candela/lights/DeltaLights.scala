package candela.lights

import candela.color.Rgb
import candela.geometry.{Ball, Frame}
import candela.math.*
import candela.sampling.Warp

/** A point light, possibly anisotropic. */
abstract class PositionedLight(position: Vec3) extends Light:
  final def isDelta: Boolean = true

  /** Intensity in the unit direction `w` of world space, in W·sr⁻¹. */
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

  final def power(scene: Ball): Float = bounds.fold(0f)(_.power)

  /** Samples a direction from a superset of those with emission; its pdf is [[directionPdf]]. */
  protected def direction(u1: Float, u2: Float): Vec3
  protected def directionPdf(w: Vec3): Float

  final def emit(
      scene: Ball,
      u1: Float,
      u2: Float,
      v1: Float,
      v2: Float,
      out: EmittedRay
  ): Unit =
    out.fromPoint(position)
    out.direction = direction(v1, v2)
    out.radiance = intensity(out.direction)
    out.pdf = directionPdf(out.direction)

  final def emissionPdf(scene: Ball, p: Vec3, n: Vec3, w: Vec3): Float = directionPdf(w)

  final def connectionPdf(from: Vec3, ray: EmittedRay): Float = (position - from).lengthSquared

object PositionedLight:
  /** Tolerance for rounding of the cosine at a cone's edge, so as not to miss light there. */
  private[lights] inline val Slack = 1e-4f

/** A point light that may emit in any direction. */
abstract class RoundLight(position: Vec3) extends PositionedLight(position):
  protected def direction(u1: Float, u2: Float): Vec3 = Warp.uniformSphere(u1, u2)
  protected def directionPdf(w: Vec3): Float = Warp.UniformSpherePdf

/** A point light that emits within a cone.
  *
  * @param axis   axis of the cone, in light space
  * @param spread 1 − cos of the angle between axis and edge
  */
abstract class ConeLight(frame: LightFrame, axis: Vec3, spread: Float)
    extends PositionedLight(frame.position):
  // An anisotropically scaled light space turns its cone into another shape in world space
  private val isCone = frame.keepsAngles
  private val axisFrame = Frame.fromZ(frame.toWorld(axis))

  protected def direction(u1: Float, u2: Float): Vec3 =
    if isCone then axisFrame.toWorld(Warp.uniformCone(u1, u2, spread))
    else Warp.uniformSphere(u1, u2)

  protected def directionPdf(w: Vec3): Float =
    if !isCone then Warp.UniformSpherePdf
    else if (w dot axisFrame.n) >= 1f - spread - PositionedLight.Slack then
      Warp.uniformConePdf(spread)
    else 0f

/** An isotropic point light of intensity `all` (W·sr⁻¹). */
final class PointLight(position: Vec3, all: Rgb) extends RoundLight(position):
  def intensity(w: Vec3): Rgb = all
  def bounds: Option[LightBounds] =
    Some(LightBounds.everywhere(position, 4f * Pi * all.max))

/** Directional light: irradiance `irradiance` on a plane facing it, arriving from `toLight` (unit).
  */
final class DistantLight(toLight: Vec3, irradiance: Rgb) extends Light:
  def isDelta: Boolean = true
  override def isInfinite: Boolean = true

  def sample(from: Vec3, u1: Float, u2: Float, out: LightSample): Unit =
    out.wi = toLight
    out.radiance = irradiance
    out.pdf = 1f
    out.isInfinite = true

  def bounds: Option[LightBounds] = None

  def power(scene: Ball): Float = irradiance.max * scene.area

  def emit(scene: Ball, u1: Float, u2: Float, v1: Float, v2: Float, out: EmittedRay): Unit =
    out.fromAfar(-toLight, scene, u1, u2)
    out.radiance = irradiance
    out.pdf = emissionPdf(scene, out.p, out.n, out.direction)

  def emissionPdf(scene: Ball, p: Vec3, n: Vec3, w: Vec3): Float =
    if scene.area > 0f then 1f / scene.area else 0f

  def connectionPdf(from: Vec3, ray: EmittedRay): Float = 1f
