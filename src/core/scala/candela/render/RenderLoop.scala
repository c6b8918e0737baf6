package candela.render

/** One rendering of a plan, from its first sample to its last: workers take samples wave by wave;
  * between waves, they pause where the rule or the listener looks at the image.
  */
private[render] final class RenderLoop(plan: RenderPlan, control: RenderControl):
  import control.{checkpointer, listener, rule, shard}

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
    val canKeepOn = plan.method.canKeepOn && shard.isWhole && checkpointer.isEmpty &&
      plan.samplesPerPixel < RenderPlan.Endless
    Live(plan, job, queue, state, planned, canKeepOn, () => seconds)
  private val timeLeft =
    TimeLeft(schedule, pixels.toDouble / shard.count, earlierSamples, rule)
  private val frequency = rule.frequency.max(listener.frequency)
  private var lastBeats = 0L
  private var lastBeat = started

  def run(): Rendering =
    listener.started(live)
    rule.begins(earlierSamples, job.film)
    listener.begins(earlierSamples, job.film)
    for end <- pauses if schedule.firstSample(end) > earlierSamples && continues do
      renderUntil(end)
    keepOn()
    reportProgress()
    for c <- checkpointer do
      // A worker's sample without end may be in the film in part
      if queue.isLost then c.discard() else c.save(state)
      c.finish()
    state.settle()
    result

  /** The waves before which the workers wait for each other. */
  private def pauses: Iterator[Int] = frequency match
    case Looks.Never => Iterator(schedule.waves)
    case Looks.Doublings => schedule.passes.iterator
    case Looks.Waves => Iterator.range(0, schedule.waves).map(_ + 1)

  /** Renders all waves before `end`, in several passes if the rule asks for fewer samples. */
  private def renderUntil(end: Int): Unit =
    val target = schedule.firstSample(end)
    val isDivisible = frequency == Looks.Waves && schedule.step > 0
    var done = Math.max(earlierSamples, schedule.firstSample(end - 1))
    while done < target && continues do
      val maxSamples = if isDivisible then rule.maxSamples else Int.MaxValue
      done = if maxSamples >= target - done then target else done + Math.max(1, maxSamples)
      renderPass(end, done)

  /** Adds samples beyond the planned ones, as long as a viewer wants them. */
  private def keepOn(): Unit =
    var wave = schedule.waves
    while live.keepsOn && continues do
      // A third of all samples is new: seldom enough for the workers to wait for each other
      val done = schedule.firstSample(wave)
      wave += Math.max(1, done / 2 / Schedule.LargestWave)
      live.extend(schedule.firstSample(wave) - done)
      renderPass(wave, schedule.firstSample(wave))

  /** Takes samples until each pixel has `samples`, none of the wave `end` or a later one. */
  private def renderPass(end: Int, samples: Int): Unit =
    queue.openUntil(end, samples)
    val passStart = seconds
    lastBeat = System.nanoTime
    Workers.run(workers, queue, () => isWorthWaiting)(() => tick())
    if frequency != Looks.Never && !queue.isStopped then
      val isWhole = samples == schedule.firstSample(end)
      val pass = Pass(
        samples,
        passStart,
        end = seconds,
        workers.map(_.seconds),
        isLast = isWhole && end >= schedule.waves,
        isWhole,
        clock,
        step = if isWhole then schedule.step else 1,
        () => queue.isStopped
      )
      val pauseStart = System.nanoTime
      if rule.frequency.include(pass) then rule.passed(pass, job.film)
      if listener.frequency.include(pass) then listener.passed(pass, job.film)
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
    if rule.isOver(clock, (System.nanoTime - lastBeat) * 1e-9) then queue.stop()

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

  private def continues: Boolean = !queue.isStopped && !rule.isReached

  /** Seconds since the start. */
  private def clock: Double = (System.nanoTime - started) * 1e-9

  /** Seconds since the start, without those of the rule and the listener. */
  private def seconds: Double = clock - pausedNanos * 1e-9

  private def result: Rendering =
    val rendering = live.rendering.copy(earlier = earlierSamples)
    val hasAll = rendering.samplesDone >= plan.samplesPerPixel
    val isComplete = hasAll || rule.isReached && rendering.samplesDone > 0
    if isComplete then rendering.copy(samplesPerPixel = rendering.samplesDone) else rendering
