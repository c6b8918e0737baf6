package candela.render

import candela.integrators.ChainWalker

/** Advances Markov chains. A sample pass has as many paths as samples of all pixels, distributed
  * over the chains in turn.
  */
private[render] final class ChainWorker(
    walker: ChainWalker,
    schedule: Schedule,
    board: Board,
    pixels: Long
) extends Worker(schedule, board):
  import ChainWorker.*

  def raysTraced: Long = walker.raysTraced

  def refused: Option[Refused] =
    Option.when(walker.refused > 0):
      Refused(walker.refused, walker.x, walker.y, 0, walker.lastMaterial)

  protected def work(chain: Int, wave: Int): Boolean =
    walker.begin(() => board.isStopped) && advance(chain, wave)

  private def advance(chain: Int, wave: Int): Boolean =
    val end = paths(chain, schedule.endSample(wave))
    var left = end - paths(chain, schedule.firstSample(wave))
    while left > 0 && !board.isStopped do
      val some = Math.min(left, AtOnce)
      walker.advance(chain, some)
      board.samplesTaken.add(some)
      left -= some
    left <= 0

  /** Number of paths of the chain after `samples` per pixel. */
  private def paths(chain: Int, samples: Int): Long =
    (samples * pixels + schedule.pieces - 1 - chain) / schedule.pieces

  protected def failure(cause: Throwable): RenderFailure =
    RenderFailure(walker.x, walker.y, 0, cause)

private object ChainWorker:
  /** Paths between two checks for cancellation. */
  val AtOnce = 1024L
