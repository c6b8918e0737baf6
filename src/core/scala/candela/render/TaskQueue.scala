package candela.render

import java.util.concurrent.ConcurrentHashMap
import java.util.concurrent.atomic.{
  AtomicInteger,
  AtomicIntegerArray,
  AtomicLong,
  AtomicLongArray,
  AtomicReference,
  LongAdder
}
import java.util.concurrent.locks.LockSupport

/** Shared state of the workers: the task queue, progress, cancellation. */
private[render] final class TaskQueue(schedule: Schedule, cancellation: Cancellation):
  private val nextStep = AtomicLong()
  private var begunStep, endStep = 0L // changed only while no worker runs
  private var untilSample = Int.MaxValue
  private val finishedWaves = AtomicIntegerArray(schedule.pieces)
  private val limitsWaves = schedule.openWaves < schedule.waves
  // How many pieces of an open wave are finished; a wave takes the place of one that is closed.
  private val finishedPieces = AtomicIntegerArray(if limitsWaves then schedule.openWaves else 0)
  private val closedWaves = AtomicInteger()
  private val firstFailure = AtomicReference[Throwable | Null](null)
  val samplesTaken: LongAdder = LongAdder()

  /** Planned samples that pixels do without. */
  val samplesSpared: LongAdder = LongAdder()
  private val gate = Gate()
  @volatile private var isEnded = false
  @volatile private var isLeft, isForgotten = false

  /** Of each piece, how much is done: samples of a tile, paths of a chain. */
  val progress: AtomicLongArray = AtomicLongArray(schedule.pieces)

  /** Pieces that were left between two values of their progress. */
  val begun: ConcurrentHashMap[Integer, BegunPiece] = ConcurrentHashMap()

  /** Opens the steps of all waves before `wave`, until each piece has so many samples. */
  def openUntil(wave: Int, samples: Int): Unit =
    // Those of a wave that was not finished are opened again
    nextStep.set(begunStep)
    endStep = wave.toLong * schedule.pieces
    untilSample = samples
    val isWhole = samples >= schedule.firstSample(wave)
    begunStep = if isWhole then endStep else endStep - schedule.pieces

  /** One more than the last sample to take for the moment. */
  def endSample: Int = untilSample

  def isStopped: Boolean = isEnded || cancellation.isRequested || firstFailure.get != null

  /** Stops the rendering, as a cancellation does. */
  def stop(): Unit = isEnded = true

  /** Whether the rendering ends without waiting for what workers are at: they leave it with the
    * next path.
    */
  def isAbandoned: Boolean = isLeft
  def abandon(): Unit = isLeft = true

  /** Whether it has ended though some workers have not: their paths don't count any more. */
  def isLost: Boolean = isForgotten
  def markLost(): Unit = isForgotten = true

  /** Called by workers wherever they may pause; false if the rendering is stopped. */
  def goesOn(): Boolean =
    gate.pass()
    !isStopped

  /** Runs `body` while all workers pause; not at all if the rendering is stopped before they do.
    *
    * @param onWait called about ten times a second until they do
    */
  def paused(body: => Unit)(onWait: () => Unit): Unit =
    gate.closed(body):
      onWait()
      !isStopped

  private[render] def start(workers: Int): Unit = gate.expect(workers)
  private[render] def end(): Unit = gate.exit()

  def failure: Option[Throwable] = Option(firstFailure.get).map(_.nn)

  /** Allocates nothing: the heap may be full. */
  def fail(cause: Throwable): Unit =
    val _ = firstFailure.compareAndSet(null, cause)

  /** Claims the next step; -1 if none is left. */
  def takeStep(): Long =
    val step = nextStep.getAndIncrement()
    if step < endStep && !isStopped then step else -1L

  /** Waits until the earlier waves of a piece are finished and the schedule opens this wave; false
    * if cancelled, or if this wave is finished: a piece that was ahead in a saved film finishes it
    * before the others, in a shortened pass.
    *
    * Another worker may still process them. Deadlock is impossible, since steps are claimed in
    * order: a worker waits only for earlier steps. Waiting also makes the other worker's
    * accumulators visible to this one.
    */
  def awaitTurn(piece: Int, wave: Int): Boolean =
    while finishedWaves.get(piece) <= wave && !isTurn(piece, wave) && goesOn() do
      LockSupport.parkNanos(TaskQueue.Pause)
    isTurn(piece, wave)

  private[render] def isTurn(piece: Int, wave: Int): Boolean =
    finishedWaves.get(piece) == wave &&
      (wave < schedule.openWaves ||
        closedWaves.get > wave - schedule.openWaves)

  def finish(piece: Int, wave: Int): Unit =
    // Counted before the piece's next wave can begin: waves are closed in order
    if limitsWaves then
      val slot = wave % schedule.openWaves
      if finishedPieces.incrementAndGet(slot) == schedule.pieces then
        finishedPieces.set(slot, 0)
        closedWaves.set(wave + 1)
    finishedWaves.set(piece, wave + 1)

/** What is there of the next step of a piece's progress.
  *
  * @param done of a tile, how many pixels have their sample, or, if they take all at once, how many
  *   samples pixels have, each spared one included; of a chain, how many paths are made
  * @param sums what becomes part of the film later: of a tile whose pixels share samples, the sums
  *   of this one, otherwise nothing; of a chain, the weight of its current path
  */
private[render] final case class BegunPiece(done: Int, sums: Array[Double])

private object TaskQueue:
  /** In nanoseconds; short beside the milliseconds of a step. */
  val Pause = 50_000L
