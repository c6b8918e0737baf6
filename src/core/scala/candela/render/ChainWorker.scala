package candela.render

import candela.integrators.ChainWalker

/** Advances Markov chains. */
private[render] final class ChainWorker(
    walker: ChainWalker,
    schedule: ChainSchedule,
    queue: TaskQueue
) extends Worker(schedule, queue):
  import ChainWorker.*

  def raysTraced: Long = walker.raysTraced

  def discarded: Option[DiscardedSamples] =
    Option.when(walker.discarded > 0):
      DiscardedSamples(walker.discarded, walker.x, walker.y, 0, walker.lastMaterial)

  protected def work(chain: Int, wave: Int): Boolean =
    !schedule.takesChain(chain) ||
      (walker.prepare(() => queue.isStopped) && advance(chain, wave))

  private def advance(chain: Int, wave: Int): Boolean =
    val end = schedule.paths(chain, schedule.endSample(wave))
    var done =
      Math.max(schedule.paths(chain, schedule.firstSample(wave)), queue.progress.get(chain))
    while done < end && queue.goesOn() && !queue.isAbandoned do
      val count = Math.min(end - done, AtOnce)
      if walk(chain, count) then
        beat()
        queue.samplesTaken.add(count)
        done += count
        queue.progress.set(chain, done)
    done >= end

  /** Makes so many paths, those included that are there; false if the chain was left before. */
  private def walk(chain: Int, paths: Long): Boolean =
    val begun = queue.begun.remove(chain)
    val (first, weight) = if begun == null then (0, 0f) else (begun.done, begun.sums(0).toFloat)
    val pathsDone = first + walker.advance(chain, paths - first, weight, () => queue.isAbandoned)
    if pathsDone < paths && pathsDone > 0 && !queue.isLost then
      queue.begun.put(chain, BegunPiece(pathsDone.toInt, Array(walker.pending.toDouble))): Unit
    pathsDone >= paths

  protected def failure(cause: Throwable): RenderFailure =
    RenderFailure(walker.x, walker.y, 0, cause)

private[render] object ChainWorker:
  /** Paths between two checks for cancellation and pauses; part of the image's definition, as a
    * chain's state is splatted whenever it stops.
    */
  val AtOnce = 1024L
