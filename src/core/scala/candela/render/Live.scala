package candela.render

import candela.film.PixelBounds

/** A rendering in progress, for observers in other threads. Reading it costs the workers nothing:
  * they go on meanwhile, and pixels may be read between two of their samples.
  *
  * @param planned   samples to take, in all pixels
  * @param canKeepOn whether it may go on beyond them
  */
final class Live private[render] (
    plan: RenderPlan,
    job: Job,
    queue: TaskQueue,
    state: RenderState,
    planned: Long,
    val canKeepOn: Boolean,
    elapsed: () => Double
):
  @volatile private var wantsMore = false
  @volatile private var further = 0
  @volatile private var expected = Outlook()
  @volatile private var isOver = false

  /** Whether to go on when the planned samples are taken, until cancelled or no longer wanted. */
  def keepsOn: Boolean = canKeepOn && wantsMore
  def keepOn(wanted: Boolean): Unit = wantsMore = wanted

  private[render] def extend(samples: Int): Unit = further += samples
  private[render] def expect(outlook: Outlook): Unit = expected = outlook

  /** All is done, as planned or by a goal. */
  private[render] def end(): Unit = isOver = true

  /** Samples per pixel to take, as far as known. */
  private[render] def samplesPerPixel: Int =
    Math.min(plan.samplesPerPixel.toLong + further, RenderPlan.Endless).toInt

  def progress: Progress =
    val outlook = if isOver then expected.copy(left = Some(0)) else expected
    val total = planned + further * plan.sampled.pixels
    Progress(queue.samplesTaken.sum + queue.samplesSpared.sum, total, elapsed(), outlook, isOver)

  /** What there is now; the result, once rendering has ended. */
  def rendering: Rendering =
    state.rendering(samplesPerPixel)
      .copy(
        samplesTaken = queue.samplesTaken.sum,
        samplesSpared = queue.samplesSpared.sum,
        seconds = elapsed()
      )

  /** The tiles that workers render at the moment; none for methods without tiles. */
  def tiles: Vector[PixelBounds] =
    job.schedule match
      case tiled: TileSchedule => state.pieces.map(tiled.tiles)
      case _ => Vector.empty
