package candela.render

import candela.diagnostics.SceneError
import java.util.concurrent.atomic.AtomicLong

/** A worker of one rendering: takes steps from the shared queue, wave by wave, and owns its scratch
  * memory.
  */
private[render] abstract class Worker(schedule: Schedule, queue: TaskQueue) extends Runnable:
  def raysTraced: Long
  def discarded: Option[DiscardedSamples]

  /** False if cancelled on the way. */
  protected def work(piece: Int, wave: Int): Boolean

  /** Adds the current position to a failure. */
  protected def failure(cause: Throwable): RenderFailure

  private val moves = AtomicLong()

  /** Counts samples, or paths, for [[beats]]. */
  protected final def beat(): Unit = moves.lazySet(moves.getPlain + 1)

  /** How often it has got on with its work, as far as other threads have seen. */
  final def beats: Long = moves.get

  private var runNanos = 0L
  @volatile private var current = Worker.Idle

  /** What it works on at the moment, for observers. */
  def piece: Option[Int] = Option(current).filter(_ != Worker.Idle)

  /** Duration of the last run, from its thread's start until the queue was empty. */
  def seconds: Double = runNanos * 1e-9

  final def run(): Unit =
    val started = System.nanoTime
    try
      var step = queue.takeStep()
      while step >= 0 do
        val wave = (step / schedule.pieces).toInt
        val piece = (step % schedule.pieces).toInt
        current = piece
        if queue.awaitTurn(piece, wave) && work(piece, wave) then queue.finish(piece, wave)
        step = queue.takeStep()
      current = Worker.Idle
      runNanos = System.nanoTime - started
    catch
      // A file of the scene can't be read any more
      case e: SceneError => throw e
      case e: Throwable => throw failure(e)

private object Worker:
  val Idle: Int = -1
