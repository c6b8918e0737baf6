package candela.render

/** One rendering of a plan, from its first sample to its last: workers take samples wave by wave;
  * between waves, they pause where a listener looks at the image.
  */
private[render] final class RenderLoop(plan: RenderPlan, control: RenderControl):
  import control.{checkpointer, rule, shard}
  private val listener = RenderListener.all(Vector(rule, control.listener))

  private val started = System.nanoTime
  private var pausedNanos = 0L
  private val job = plan.method.job(plan, shard)
  private val schedule = job.schedule
  private val queue = TaskQueue(schedule, control.cancellation)
  private val workers =
    Vector.fill(Math.min(control.threads.toLong, schedule.steps).toInt)(job.worker(queue))
  private val state = RenderState(job, queue, workers)
  checkpointer.foreach(_.restore(state))

  private val earlierSamples = state.samplesDone
  private val pixels = plan.sampled.pixels
  private val live =
    val planned = pixels * Math.max(0, plan.samplesPerPixel - earlierSamples) / shard.count
    val canKeepOn = plan.method.canKeepOn && plan.adaptive.isEmpty && shard.isWhole &&
      checkpointer.isEmpty && plan.samplesPerPixel < plan.maxSamples
    Live(plan, job, queue, state, planned, canKeepOn, () => seconds)
  private val timeLeft =
    TimeLeft(schedule, pixels.toDouble / shard.count, earlierSamples, rule, listener)
  private val frequency = listener.frequency
  private var lastBeats = 0L
  private var lastBeat = started

  def run(): Rendering =
    listener.started(live)
    listener.begins(earlierSamples, state.maxSamplesDone, job.film)
    try
      // A rendering that a goal ends has millions of waves, which nobody looks through at its end
      pauses.dropWhile(schedule.firstSample(_) <= earlierSamples).takeWhile(_ => continues)
        .foreach(renderUntil)
      keepOn()
      if isComplete(state.samplesDone) then live.end()
      reportProgress()
    catch
      // Of a listener, or an interrupt; a sample that fails may be in the film in part
      case e: Exception if queue.failure.isEmpty =>
        save()
        throw e
    save()
    state.settle()
    result

  private def save(): Unit =
    for c <- checkpointer do
      // A worker's sample without end may be in the film in part
      if queue.isLost then c.discard() else c.save(state)
      c.finish()

  /** The waves before which the workers wait for each other. */
  private def pauses: Iterator[Int] = frequency match
    case Looks.Never => Iterator(schedule.waves)
    case Looks.Doublings => schedule.doublings.iterator
    case Looks.Waves => Iterator.range(0, schedule.waves).map(_ + 1)

  /** Renders all waves before `endWave`, in several passes if the rule asks for fewer samples. */
  private def renderUntil(endWave: Int): Unit =
    val target = schedule.firstSample(endWave)
    val isDivisible = frequency == Looks.Waves && schedule.step > 0
    var done = Math.max(earlierSamples, schedule.firstSample(endWave - 1))
    while done < target && continues do
      val maxSamples = if isDivisible then rule.maxSamples else Int.MaxValue
      done = if maxSamples >= target - done then target else done + Math.max(1, maxSamples)
      renderPass(endWave, done)

  /** Adds samples beyond the planned ones, as long as a viewer wants them. */
  private def keepOn(): Unit =
    var wave = schedule.waves
    def done = schedule.firstSample(wave)
    // A third of all samples is new: seldom enough for the workers to wait for each other
    def next = wave + Math.max(1, done / 2 / Schedule.LargestWave)
    while live.keepsOn && continues && schedule.firstSample(next) <= plan.maxSamples do
      val earlier = done
      wave = next
      live.extend(done - earlier)
      renderPass(wave, done)

  /** Takes samples until each pixel has `samples`, none of the wave `endWave` or a later one. */
  private def renderPass(endWave: Int, samples: Int): Unit =
    queue.openUntil(endWave, samples)
    val passStart = seconds
    lastBeat = System.nanoTime
    Workers.run(workers, queue, () => isWorthWaiting)(() => tick())
    if frequency != Looks.Never && !queue.isStopped then
      val isUnshortened = samples == schedule.firstSample(endWave)
      val pass = Pass(
        samples,
        passStart,
        endSeconds = seconds,
        workers.map(_.seconds),
        isLast = isUnshortened && endWave >= schedule.waves,
        isUnshortened,
        clock,
        step = if isUnshortened then schedule.step else 1,
        () => queue.isStopped
      )
      val pauseStart = System.nanoTime
      listener.passed(pass, job.film)
      pausedNanos += System.nanoTime - pauseStart

  /** Called about ten times a second. */
  private def tick(): Unit =
    observe()
    for c <- checkpointer if c.isDue && !queue.isStopped do
      queue.paused(c.save(state))(() => observe())
      c.finish()

  private def observe(): Unit =
    reportProgress()
    if isMoving then lastBeat = System.nanoTime
    if rule.stopsNow(clock, (System.nanoTime - lastBeat) * 1e-9) then queue.stop()

  private def reportProgress(): Unit =
    val current = live.progress
    live.expect(timeLeft.outlook(current.done, live.samplesPerPixel, current.seconds, clock))
    listener.progressed(live.progress)

  /** Whether a worker has completed a sample since the last call. */
  private def isMoving: Boolean =
    val beats = workers.map(_.beats).sum
    val hasMoved = beats != lastBeats
    lastBeats = beats
    hasMoved

  // Without a copy to save, samples that are not complete in all pixels of a tile may be lost
  private def isWorthWaiting = checkpointer.isDefined && isMoving

  private def continues: Boolean = !queue.isStopped && !rule.stopsAfterPass

  /** Seconds since the start. */
  private def clock: Double = (System.nanoTime - started) * 1e-9

  /** Seconds since the start, without those of the listeners. */
  private def seconds: Double = clock - pausedNanos * 1e-9

  private def result: Rendering =
    val rendering = live.rendering.copy(earlier = earlierSamples)
    if isComplete(rendering.samplesDone) then
      rendering.copy(samplesPerPixel = rendering.samplesDone)
    else rendering

  private def isComplete(samplesDone: Int): Boolean =
    samplesDone >= plan.samplesPerPixel || rule.stopsAfterPass && samplesDone > 0
