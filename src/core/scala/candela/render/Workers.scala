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
  private val firstFailure = AtomicReference[Option[Throwable]](None)
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

  def isStopped: Boolean = isEnded || cancellation.isRequested || firstFailure.get.isDefined

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

  def failure: Option[Throwable] = firstFailure.get

  def fail(cause: Throwable): Unit =
    val _ = firstFailure.compareAndSet(None, Some(cause))

  /** Claims the next step; -1 if none is left. */
  def takeStep(): Long =
    val step = nextStep.getAndIncrement()
    if step < endStep && !isStopped then step else -1L

  /** Waits until the earlier waves of a piece are finished and the schedule opens this wave; false
    * if cancelled.
    *
    * Another worker may still process them. Deadlock is impossible, since steps are claimed in
    * order: a worker waits only for earlier steps. Waiting also makes the other worker's
    * accumulators visible to this one.
    */
  def awaitTurn(piece: Int, wave: Int): Boolean =
    while !isTurn(piece, wave) && goesOn() do LockSupport.parkNanos(TaskQueue.Pause)
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

/** Runs workers in parallel until all have ended. */
private[render] object Workers:

  /** Interval of progress reports, in milliseconds. */
  private val Tick = 100L

  /** How long a stopped worker may stand still before it must leave its sample, how long it may
    * continue with it, and how long it may take to leave it. With a tick, these add up to less than
    * a second.
    */
  private val MaxStillNanos = 400_000_000L
  private val MaxMovingNanos = 500_000_000L
  private val MaxLeavingNanos = 250_000_000L

  /** Runs each worker in its own thread. An exception in one stops the others (through the queue)
    * and is rethrown here. `onTick` runs about ten times a second in the caller's thread.
    *
    * A stopped rendering does not wait for samples that take long: after a while the workers
    * abandon them, and the queue is lost if some worker does not end even so.
    *
    * @param isMoving whether samples have been taken since it was last asked, and are worth waiting
    *   for
    */
  def run(workers: Vector[Runnable], queue: TaskQueue, isMoving: () => Boolean)(
      onTick: () => Unit
  ): Unit =
    val threads = workers.zipWithIndex.map: (worker, i) =>
      val guarded: Runnable = () =>
        try worker.run()
        catch case e: Throwable => queue.fail(e)
        finally queue.end()
      ThreadPool.thread(s"worker-${i + 1}", guarded)
    queue.start(threads.size)
    threads.foreach(_.start())
    try
      for thread <- threads do
        while thread.isAlive && !queue.isStopped do
          thread.join(Tick)
          onTick()
    catch case e: Throwable => queue.fail(e)
    end(threads, queue, isMoving)
    queue.failure.foreach(e => throw e)

  private def end(threads: Vector[Thread], queue: TaskQueue, isMoving: () => Boolean): Unit =
    val stopped = System.nanoTime
    var lastMove = stopped
    def isTooLong =
      val time = System.nanoTime
      time - lastMove > MaxStillNanos || time - stopped > MaxMovingNanos
    while threads.exists(_.isAlive) && !(queue.isStopped && isTooLong) do
      threads.find(_.isAlive).foreach(_.join(Tick))
      if isMoving() then lastMove = System.nanoTime
    if threads.exists(_.isAlive) then
      queue.abandon()
      val end = System.nanoTime + MaxLeavingNanos
      for thread <- threads do
        val millisLeft = (end - System.nanoTime) / 1_000_000
        if millisLeft > 0 then thread.join(millisLeft)
      if threads.exists(_.isAlive) then queue.markLost()
