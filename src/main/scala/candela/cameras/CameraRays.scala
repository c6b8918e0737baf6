package candela.cameras

import candela.geometry.Ray
import candela.sampling.Sampler

/** The rays of samples: through a point of the aperture, at a time while the shutter is open, and
  * with neighbours where textures ask for them. Mutable, one per worker.
  *
  * @param shutter           when it is open, if anything moves
  * @param differentialScale of the neighbours; 0: nothing in the scene asks for them
  */
final class CameraRays(camera: Camera, shutter: Option[Shutter], differentialScale: Float):
  private val weighs = camera.weighs
  private val moves = shutter.isDefined
  private val open = shutter.getOrElse(Shutter(0f, 0f))
  private val scratch = Ray()

  /** What [[next]] writes. */
  val ray: Ray = Ray()

  /** Writes the ray through the film at (`x`, `y`), in pixels, by the sampler's next numbers.
    *
    * @return what its light counts; 0: the lenses let none through, and there is no ray
    */
  def next(x: Float, y: Float, sampler: Sampler): Float =
    sampler.next2D()
    if moves then
      ray.time = open.at(sampler.next1D()) // leaves x and y as they are
      scratch.time = ray.time
    camera.generate(x, y, sampler.x, sampler.y, ray)
    val weight = if weighs then ray.weight else 1f
    if weight != 0f && differentialScale > 0f then
      camera.differential(x, y, sampler.x, sampler.y, differentialScale, ray, scratch)
    weight
