package candela.integrators

import candela.color.Rgb
import candela.geometry.{Frame, Ray}
import candela.math.*
import candela.sampling.{Sampler, Warp}
import candela.scene.Scene

/** What [[AmbientOcclusion]] looks for, and how it writes that down.
  *
  * @param samples rays from each point
  * @param start   in scene units: what is nearer hides nothing
  * @param end     in scene units: what is farther hides nothing
  * @param cosine  are rays chosen by the cosine of their angle to the normal?
  * @param weighs  do rays count by that cosine? Else all count the same
  * @param open    value of a point that nothing hides
  * @param showsSky do rays that meet nothing show what surrounds the scene? Else they are black
  */
final case class Occlusion(
    samples: Int,
    start: Float,
    end: Float,
    cosine: Boolean,
    weighs: Boolean,
    open: Rgb,
    showsSky: Boolean
)

/** How much of the hemisphere above a point is open, whatever the materials and lights are.
  *
  * Source: Zhukov, Iones, Kronin, "An Ambient Light Illumination Model", Eurographics Workshop on
  * Rendering 1998.
  */
final class AmbientOcclusion(scene: Scene, rule: Occlusion, volumes: VolumeMarch | Null = null)
    extends LightTransport(scene, volumes):
  import rule.*

  protected def over(scene: Scene): AmbientOcclusion =
    AmbientOcclusion(scene, rule, VolumeMarch.copy(volumes))

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    shadowRay.time = ray.time
    val march = volumes
    if march != null then march.start(ray, sampler)
    var light = Rgb.Black
    var throughput = Rgb.White
    var alive = true
    while alive do
      rays += 1
      val met = scene.closest(ray, hit)
      if march != null then
        march.march(ray, sampler)
        light += throughput * march.light
        throughput = throughput * march.transmitted
      if !met then
        if showsSky then light += throughput * escaped(ray, (_, _) => 1f)
        alive = false
      else
        scene.surface(ray, hit, at)
        alive = scene.isInterface(at)
        if alive then
          ray.set(at.offsetOrigin(ray.direction), ray.direction, Float.PositiveInfinity)
          scene.passed(ray)
        else light += throughput * open * openness(-ray.direction, sampler)
    light

  /** The part of the hemisphere around the true surface's normal that nothing hides. */
  private def openness(wo: Vec3, sampler: Sampler): Float =
    val n = if (wo dot at.geometricNormal) < 0f then -at.geometricNormal else at.geometricNormal
    val frame = Frame.around(n)
    sampler.next2D()
    // One point of the sampler, and the others of a sequence that starts there
    var (u1, u2) = (sampler.x, sampler.y)
    var sum = 0f
    var i = 0
    while i < samples do
      val w = if cosine then Warp.cosineHemisphere(u1, u2) else Warp.uniformHemisphere(u1, u2)
      val wi = frame.toWorld(w)
      shadowRay.set(at.offsetOrigin(wi) + wi * start, wi, end - start)
      rays += 1
      // By the cosine, over its mean: 1 is a half of its density
      if !scene.isOccluded(shadowRay, shadowHit) then
        sum += (if weighs && !cosine then 2f * w.z else 1f)
      u1 = AmbientOcclusion.wrapped(u1 + AmbientOcclusion.StepX)
      u2 = AmbientOcclusion.wrapped(u2 + AmbientOcclusion.StepY)
      i += 1
    sum / samples

object AmbientOcclusion:
  /** Of the sequence with the lowest discrepancy known of those that add a constant: Roberts, "The
    * Unreasonable Effectiveness of Quasirandom Sequences", 2018: 1/φ and 1/φ² of the real root of
    * φ³ = φ + 1.
    */
  private inline val StepX = 0.7548776662f
  private inline val StepY = 0.5698402910f

  private inline def wrapped(u: Float): Float = if u >= 1f then u - 1f else u
