package candela.render

import candela.film.PixelBounds

/** A rendering in progress, for observers in other threads. Reading it costs the workers nothing:
  * they go on meanwhile, and pixels may be read between two of their samples.
  *
  * @param total samples to take, in all pixels
  */
final class Live private[render] (
    plan: RenderPlan,
    job: Job,
    board: Board,
    workers: Vector[Worker],
    state: RenderState,
    total: Long,
    elapsed: () => Double
):
  def progress: Progress = Progress(board.samplesTaken.sum, total, elapsed())

  /** What there is now; the result, once rendering has ended. */
  def rendering: Rendering =
    Renderer.rendering(state, job, workers, plan.sampler.samplesPerPixel)
      .copy(samplesTaken = board.samplesTaken.sum, seconds = elapsed())

  /** The tiles that workers render at the moment; none for methods without tiles. */
  def tiles: Vector[PixelBounds] =
    job.schedule match
      case tiled: TileSchedule => workers.flatMap(_.piece).map(tiled.tiles)
      case _ => Vector.empty
