package candela.render

import java.util.concurrent.atomic.{AtomicIntegerArray, AtomicLong, AtomicReference, LongAdder}
import java.util.concurrent.locks.LockSupport

/** What the workers of one rendering share: who does what, what is done, and whether to stop. */
private[render] final class Board(schedule: Schedule, cancellation: Cancellation):
  private val nextStep = AtomicLong()
  private var endStep = 0L // changed only while there are no workers
  private val finishedWaves = AtomicIntegerArray(schedule.pieces)
  private val limitsWaves = schedule.openWaves < schedule.waves
  private val finishedPieces = AtomicIntegerArray(if limitsWaves then schedule.waves else 0)
  private val firstFailure = AtomicReference[Option[Throwable]](None)
  val samplesTaken: LongAdder = LongAdder()

  /** Allows the steps of all waves before `wave`. */
  def openUntil(wave: Int): Unit =
    // Workers that found nothing to do have counted on.
    nextStep.set(endStep)
    endStep = wave.toLong * schedule.pieces

  def isStopped: Boolean = cancellation.isRequested || firstFailure.get.isDefined

  def failure: Option[Throwable] = firstFailure.get

  def fail(cause: Throwable): Unit =
    val _ = firstFailure.compareAndSet(None, Some(cause))

  /** The next step that nobody has taken, or -1 if there is no more to do. */
  def takeStep(): Long =
    val step = nextStep.getAndIncrement()
    if step < endStep && !isStopped then step else -1L

  /** Waits until the earlier waves of a piece are finished, and until the schedule opens this wave;
    * false if that won't be.
    *
    * Another worker may still be at them. There is no deadlock, since steps are taken in order:
    * whoever waits, waits for an earlier step. This is also what makes that worker's sums visible
    * to this one.
    */
  def awaitTurn(piece: Int, wave: Int): Boolean =
    while !isTurn(piece, wave) && !isStopped do LockSupport.parkNanos(Board.Pause)
    isTurn(piece, wave)

  private[render] def isTurn(piece: Int, wave: Int): Boolean =
    finishedWaves.get(piece) == wave &&
      (wave < schedule.openWaves ||
        finishedPieces.get(wave - schedule.openWaves) == schedule.pieces)

  def finish(piece: Int, wave: Int): Unit =
    finishedWaves.set(piece, wave + 1)
    if limitsWaves then
      val _ = finishedPieces.incrementAndGet(wave)

  /** Samples that every pixel has. */
  def samplesDone: Int =
    val wave = (0 until schedule.pieces).map(finishedWaves.get).min
    schedule.firstSample(wave)

private object Board:
  /** Nanoseconds; short beside the milliseconds that a step takes. */
  val Pause = 50_000L

/** Runs workers side by side until all have ended. */
private[render] object Workers:

  /** Milliseconds between two reports of progress. */
  private val Tick = 100L

  /** Runs each worker in a thread of its own. What one throws stops the others (through the board)
    * and is thrown here; `onTick` runs about ten times a second in the caller's thread.
    */
  def run(workers: Vector[Runnable], board: Board)(onTick: () => Unit): Unit =
    val threads = workers.zipWithIndex.map: (worker, i) =>
      val guarded: Runnable = () =>
        try worker.run()
        catch case e: Throwable => board.fail(e)
      val thread = Thread(guarded, s"candela-worker-${i + 1}")
      thread.setDaemon(true)
      thread
    threads.foreach(_.start())
    try
      for thread <- threads do
        while thread.isAlive do
          thread.join(Tick)
          onTick()
    catch case e: Throwable => board.fail(e)
    threads.foreach(_.join())
    board.failure.foreach(e => throw e)
