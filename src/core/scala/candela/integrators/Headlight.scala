package candela.integrators

import candela.bsdf.DirectionalAlbedo
import candela.color.Rgb
import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** Shades by the angle to the camera, as if its light were the only one, without shadows. Needs few
  * rays, whatever the lights, and has no noise. Media are ignored, but their boundaries show.
  *
  * @param white of the scene's colours
  */
final class Headlight(scene: Scene, white: Rgb) extends Integrator:
  private val hit = Hit()
  private val point = scene.newPoint()
  private var rays = 0L

  def raysTraced: Long = rays
  override def lastMaterial: Int = point.material

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    val wo = -ray.direction
    rays += 1
    var isHit = scene.closest(ray, hit)
    if isHit then scene.surface(ray, hit, point)
    // Seen where nothing is behind them: they may enclose a cloud.
    var mist = 0f
    while isHit && scene.isInterface(point) do
      mist = Math.max(mist, Headlight.Mist * facing(wo))
      scene.passThrough(ray, point)
      rays += 1
      isHit = scene.closest(ray, hit)
      if isHit then scene.surface(ray, hit, point)
    if isHit then shade(wo) else white * (Headlight.Background + mist)

  private def shade(wo: Vec3): Rgb =
    if point.areaLight >= 0 && !scene.surfaceLight(point).radiance(point, wo).isBlack then white
    else
      val albedo = DirectionalAlbedo(scene.bsdf(point), point.frame.toLocal(wo), Headlight.Samples)
      albedo * lerp(facing(wo), Headlight.Grazing, 1f)

  private def facing(wo: Vec3): Float = Math.abs(point.frame.n dot wo)

object Headlight:
  private val Background = 0.05f
  private val Mist = 0.3f

  /** Brightness of surfaces seen from the side. */
  private val Grazing = 0.2f

  /** Enough for a first look. */
  private val Samples = 4
