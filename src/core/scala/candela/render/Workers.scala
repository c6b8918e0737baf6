package candela.render

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
    * and is rethrown here, as is one of `onTick`, or an interrupt, when all have ended. `onTick`
    * runs about ten times a second in the caller's thread.
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
      val thread = ThreadPool.thread(s"worker-${i + 1}", guarded)
      // A full heap may strike once more on the way out; the queue has the first failure
      thread.setUncaughtExceptionHandler((_, _) => ())
      thread
    queue.start(threads.size)
    threads.foreach(_.start())
    val thrown =
      try
        for thread <- threads do
          while thread.isAlive && !queue.isStopped do
            thread.join(Tick)
            onTick()
        None
      catch
        case e: Throwable =>
          queue.stop()
          Some(e)
    end(threads, queue, isMoving)
    queue.failure.orElse(thrown).foreach(e => throw e)

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
