package candela.bidirectional

import candela.base.loop
import candela.cameras.CameraRays
import candela.film.View
import candela.integrators.Integrator
import candela.sampling.{IndependentSampler, Sampler}

/** Paths from the camera that pilots follow, two for each of some pixels.
  *
  * @param seed of their random numbers
  */
private final class CameraPairs(view: View, seed: Int):
  private val spread = SpreadPlaces(view)
  private val rays = CameraRays(view.camera, view.shutter, view.differentialScale)
  private val sampler = IndependentSampler(1, seed)

  /** Follows them, and adds them to the blocks of their pixels.
    *
    * @param after called after each pair with its pixel
    * @return rays of a path, on average
    */
  def follow(count: Int, integrator: Integrator, blocks: PilotBlocks)(
      after: (Int, Int) => Unit
  ): Double =
    loop(count): k =>
      val first = radiance(integrator, 2 * k, k)
      val second = radiance(integrator, 2 * k + 1, k)
      blocks.addPair(pixelX(k), pixelY(k), first, second)
      after(pixelX(k), pixelY(k))
    integrator.raysTraced.toDouble / (2 * count)

  def start(sampler: Sampler, k: Int): Unit =
    sampler.start(k % view.width, k / view.width, 0)

  def pixelX(k: Int): Int = Math.min(spread.x(k).toInt, view.width - 1)
  def pixelY(k: Int): Int = Math.min(spread.y(k).toInt, view.height - 1)

  private def radiance(integrator: Integrator, k: Int, pixel: Int): Float =
    start(sampler, k)
    sampler.next2D()
    val weight = rays.next(pixelX(pixel) + sampler.x, pixelY(pixel) + sampler.y, sampler)
    val found = if weight == 0f then 0f else integrator.radiance(rays.ray, sampler).average * weight
    if found.isFinite then found else 0f
