package candela.caustics

import candela.base.loop
import candela.concurrency.Parallel
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

  /** Follows the pairs `from` to `until`, and adds them to the blocks of their pixels.
    *
    * @param first,second follow the paths of each pair
    */
  def follow(
      from: Int,
      until: Int,
      first: Integrator,
      second: Integrator,
      blocks: PilotBlocks
  ): Unit =
    loop(from, until): k =>
      blocks.addPair(
        pixelX(k),
        pixelY(k),
        radiance(first, 2 * k, k),
        radiance(second, 2 * k + 1, k)
      )
    blocks.rays += first.raysTraced
    if second ne first then blocks.rays += second.raysTraced

  def pixelX(k: Int): Int = Math.min(spread.x(k).toInt, view.width - 1)
  def pixelY(k: Int): Int = Math.min(spread.y(k).toInt, view.height - 1)

  private def radiance(integrator: Integrator, k: Int, pixel: Int): Float =
    CameraPairs.start(view, sampler, k)
    sampler.next2D()
    val weight = rays.next(pixelX(pixel) + sampler.x, pixelY(pixel) + sampler.y, sampler)
    val brightness =
      if weight == 0f then 0f else integrator.radiance(rays.ray, sampler).average * weight
    if brightness.isFinite then brightness else 0f

private object CameraPairs:
  /** Pairs that are followed by one thread. */
  inline val OfPart = 128

  /** Follows the pairs `from` to `until`, in parts that threads share.
    *
    * @param integrators new ones for a part: of the first path of each pair, and of the second
    */
  def followed(view: View, seed: Int, pool: Parallel, from: Int, until: Int)(
      integrators: () => (Integrator, Integrator)
  ): PilotBlocks =
    val total = PilotBlocks(view)
    pool
      .map((until - from) / OfPart): i =>
        val blocks = PilotBlocks(view)
        val start = from + i * OfPart
        val (first, second) = integrators()
        CameraPairs(view, seed).follow(start, start + OfPart, first, second, blocks)
        blocks
      .foreach(total.add)
    total

  /** Starts the path `k` of a pilot. */
  def start(view: View, sampler: Sampler, k: Int): Unit =
    sampler.start(k % view.width, k / view.width, 0)
