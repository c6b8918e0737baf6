package candela.bidirectional

import candela.base.{Parallel, loop}
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
    * @param integrator a new one
    * @param after called after each pair with its pixel
    */
  def follow(from: Int, until: Int, integrator: Integrator, blocks: PilotBlocks)(
      after: (Int, Int) => Unit
  ): Unit =
    loop(from, until): k =>
      val first = radiance(integrator, 2 * k, k)
      val second = radiance(integrator, 2 * k + 1, k)
      blocks.addPair(pixelX(k), pixelY(k), first, second)
      after(pixelX(k), pixelY(k))
    blocks.rays += integrator.raysTraced

  def pixelX(k: Int): Int = Math.min(spread.x(k).toInt, view.width - 1)
  def pixelY(k: Int): Int = Math.min(spread.y(k).toInt, view.height - 1)

  private def radiance(integrator: Integrator, k: Int, pixel: Int): Float =
    CameraPairs.start(view, sampler, k)
    sampler.next2D()
    val weight = rays.next(pixelX(pixel) + sampler.x, pixelY(pixel) + sampler.y, sampler)
    val found = if weight == 0f then 0f else integrator.radiance(rays.ray, sampler).average * weight
    if found.isFinite then found else 0f

private object CameraPairs:
  /** Pairs that are followed by one thread. */
  inline val OfPart = 128

  /** Follows the pairs `from` to `until`, in parts that threads share.
    *
    * @param begin gives a new integrator for a part, and what is called after each of its pairs,
    *              with the pixel
    */
  def followed(view: View, seed: Int, pool: Parallel, from: Int, until: Int)(
      begin: PilotBlocks => (Integrator, (Int, Int) => Unit)
  ): PilotBlocks =
    val (all, _) = counted(view, seed, pool, from, until): part =>
      val (integrator, after) = begin(part)
      (integrator, after, ())
    all

  /** Likewise, with what each part has counted, in their order. */
  def counted[A](view: View, seed: Int, pool: Parallel, from: Int, until: Int)(
      begin: PilotBlocks => (Integrator, (Int, Int) => Unit, A)
  ): (PilotBlocks, Vector[A]) =
    val all = PilotBlocks(view)
    val parts = pool.map((until - from) / OfPart): i =>
      val part = PilotBlocks(view)
      val (integrator, after, count) = begin(part)
      val start = from + i * OfPart
      CameraPairs(view, seed).follow(start, start + OfPart, integrator, part)(after)
      (part, count)
    for (part, _) <- parts do all.add(part)
    (all, parts.map(_._2).toVector)

  /** Starts the path `k` of a pilot. */
  def start(view: View, sampler: Sampler, k: Int): Unit =
    sampler.start(k % view.width, k / view.width, 0)
