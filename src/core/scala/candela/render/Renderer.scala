package candela.render

import candela.color.Rgb
import candela.scene.PathReport

/** Renders a plan to an image. */
object Renderer:

  /** Renders with `threads` workers. The image is deterministic, bit-identical for any thread
    * count: sums are exact, or of one tile, which adds its samples in order.
    *
    * @param listener     follows the rendering, in the caller's thread
    * @param shard        part of the samples to take
    * @param checkpointer keeps the state, if it is to be kept
    * @throws RenderFailure if a sample fails; all workers then stop
    * @throws candela.base.SceneError if a file of the scene can't be read any more; likewise
    */
  def render(
      plan: RenderPlan,
      threads: Int,
      cancellation: Cancellation = Cancellation(),
      listener: RenderListener = RenderListener.Silent,
      shard: Shard = Shard.Whole,
      checkpointer: Option[Checkpointer] = None
  ): Rendering =
    require(threads >= 1, s"`threads` must be at least 1, found $threads")
    val started = System.nanoTime
    var paused = 0L
    def clock = (System.nanoTime - started) * 1e-9
    def seconds = clock - paused * 1e-9

    val samplesPerPixel = plan.samplesPerPixel
    val job = Job(plan, shard)
    val schedule = job.schedule
    val queue = TaskQueue(schedule, cancellation)
    val workers = Vector.fill(Math.min(threads.toLong, schedule.steps).toInt)(job.worker(queue))

    val state = RenderState(job, queue, workers)
    checkpointer.foreach(_.restore(state))
    val earlier = state.samplesDone
    val pixels = plan.sampled.pixels
    val total = pixels * Math.max(0, samplesPerPixel - earlier) / shard.count
    val canKeepOn = plan.method.canKeepOn && shard.isWhole && checkpointer.isEmpty &&
      samplesPerPixel < RenderPlan.Endless
    val live = Live(plan, job, queue, workers, state, total, canKeepOn, () => seconds)
    val timeLeft = TimeLeft(schedule, pixels.toDouble / shard.count, earlier, listener)
    def progress() =
      val current = live.progress
      live.expect(timeLeft.outlook(current.done, live.samplesPerPixel, current.seconds, clock))
      listener.progressed(live.progress)
    listener.started(live)
    var beats = 0L
    var lastBeat = started
    def isMoving() =
      val latestBeats = workers.map(_.beats).sum
      val hasMoved = latestBeats != beats
      beats = latestBeats
      hasMoved
    def observe() =
      progress()
      if isMoving() then lastBeat = System.nanoTime
      val stillSeconds = (System.nanoTime - lastBeat) * 1e-9
      if listener.isOver(clock, stillSeconds) then queue.stop()
    def tick() =
      observe()
      for k <- checkpointer if k.isDue && !queue.isStopped do
        queue.paused(k.save(state))(() => observe())
        k.finish()
    // Without a copy to keep, samples that are not complete in all pixels of a tile may be lost
    def isWorthWaiting() = checkpointer.isDefined && isMoving()
    val looks = listener.looks
    listener.begins(earlier, job.film)
    def isNew(end: Int) = schedule.firstSample(end) > earlier
    def goesOn = !queue.isStopped && !listener.isEnough

    /** Takes all samples before the wave `end`, until there are `done` per pixel. */
    def take(end: Int, done: Int): Unit =
      queue.openUntil(end, done)
      val start = seconds
      lastBeat = System.nanoTime
      Workers.run(workers, queue, () => isWorthWaiting())(() => tick())
      if looks != Looks.Never && !queue.isStopped then
        val isWhole = done == schedule.firstSample(end)
        val isLast = isWhole && end >= schedule.waves
        val busy = workers.map(_.seconds)
        val step = if isWhole then schedule.step else 1
        val pass =
          Pass(done, start, seconds, busy, isLast, isWhole, clock, step, () => queue.isStopped)
        val stopped = System.nanoTime
        listener.passed(pass, job.film)
        paused += System.nanoTime - stopped

    def run(end: Int): Unit =
      val target = schedule.firstSample(end)
      val mayDivide = looks == Looks.Waves && schedule.step > 0
      var done = Math.max(earlier, schedule.firstSample(end - 1))
      while done < target && goesOn do
        val maxSamples = if mayDivide then listener.most else Int.MaxValue
        done = if maxSamples >= target - done then target else done + Math.max(1, maxSamples)
        take(end, done)
    ends(schedule, looks).filter(isNew).takeWhile(_ => goesOn).foreach(run)
    var wave = schedule.waves
    while live.keepsOn && goesOn do
      // A third of all samples is new: seldom enough for the workers to wait for each other
      val done = schedule.firstSample(wave)
      wave += Math.max(1, done / 2 / Schedule.LargestWave)
      live.extend(schedule.firstSample(wave) - done)
      take(wave, schedule.firstSample(wave))
    progress()
    for k <- checkpointer do
      // What some worker is at may be in the film in part
      if queue.isLost then k.lose() else k.save(state)
      k.finish()
    job.settle(queue)

    val result = live.rendering.copy(earlier = earlier)
    val hasAll = result.samplesDone >= samplesPerPixel
    val isDone = hasAll || (listener.isEnough && result.samplesDone > 0)
    if isDone then result.copy(samplesPerPixel = result.samplesDone) else result

  /** The image of a saved state, or of several that add up to one.
    *
    * @param load loads them
    */
  def gather(plan: RenderPlan, load: RenderState => Unit): Rendering =
    val job = Job(plan, Shard.Whole)
    val queue = TaskQueue(job.schedule, Cancellation())
    val state = RenderState(job, queue, Vector.empty)
    load(state)
    job.settle(queue)
    rendering(state, job, Vector.empty, state.samplesDone)

  private[render] def rendering(
      state: RenderState,
      job: Job,
      workers: Vector[Worker],
      samplesPerPixel: Int
  ): Rendering =
    val rays = workers.map(_.raysTraced).sum
    Rendering(
      job.film,
      samplesPerPixel,
      state.samplesDone,
      0,
      rays,
      0,
      state.refused,
      job.layers,
      job.guide.map(_.outcome),
      job.guide.fold(0.0)(_.seconds)
    )

  /** The waves after which the workers wait for each other. */
  private def ends(schedule: Schedule, looks: Looks): Iterator[Int] = looks match
    case Looks.Never => Iterator(schedule.waves)
    case Looks.Doublings => schedule.passes.iterator
    case Looks.Waves => Iterator.range(0, schedule.waves).map(_ + 1)

  /** Traces a single sample, identical to that of [[render]], and reports its path to `report`.
    *
    * @return its light as accumulated by the film; none if it was discarded
    */
  def trace(plan: RenderPlan, x: Int, y: Int, sample: Int, report: PathReport): Option[Rgb] =
    val (film, worker) = Job.single(plan, x, y, report)
    worker.take(x, y, sample)
    val data = film.toImage(1f).data
    Option.when(worker.refused.isEmpty)(Rgb(data(0), data(1), data(2)))
