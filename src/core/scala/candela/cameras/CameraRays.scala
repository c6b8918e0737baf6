package candela.cameras

import candela.geometry.Ray
import candela.sampling.Sampler

/** Generates the camera rays of samples: lens position, time, and differentials if textures need
  * them. Mutable, one per worker.
  *
  * @param shutter           shutter interval, if anything is animated
  * @param differentialScale scale of the differentials; 0 if nothing in the scene needs them
  * @param hidesSky          whether the camera sees no sky
  */
final class CameraRays(
    camera: Camera,
    shutter: Option[Shutter],
    differentialScale: Float,
    hidesSky: Boolean = false
):
  private val weighs = camera.weighs
  private val hasLens = camera.hasLens
  private val moves = shutter.isDefined
  private val open = shutter.getOrElse(Shutter(0f, 0f))
  private val scratch = Ray()

  /** Output of [[next]]. */
  val ray: Ray = Ray()

  /** Generates the ray through the film at (`x`, `y`), in pixels, from the sampler's next
    * dimensions.
    *
    * @return the ray's weight; 0 if the lens system blocks it, and there is no ray
    */
  def next(x: Float, y: Float, sampler: Sampler): Float =
    sampler.next2D(matters = hasLens)
    if moves then
      ray.time = open.at(sampler.next1D()) // leaves x and y unchanged
      scratch.time = ray.time
    camera.generate(x, y, sampler.x, sampler.y, ray)
    ray.isPrimary = true
    ray.hidesSky = hidesSky
    val weight = if weighs then ray.weight else 1f
    if weight != 0f && differentialScale > 0f then
      camera.differential(x, y, sampler.x, sampler.y, differentialScale, ray, scratch)
    weight
