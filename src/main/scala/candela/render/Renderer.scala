package candela.render

import candela.color.Rgb
import candela.scene.PathReport

/** Renders a plan to an image. */
object Renderer:

  /** Renders with `threads` workers. The image is deterministic, bit-identical for any thread
    * count: each pixel belongs to one tile, which adds its samples in order.
    *
    * @param onProgress     called about ten times a second, and at the end, in the caller's thread
    * @param witness        image observer; doesn't affect the image
    * @throws RenderFailure if a sample fails; all workers then stop
    */
  def render(
      plan: RenderPlan,
      threads: Int,
      cancellation: Cancellation = Cancellation(),
      onProgress: Progress => Unit = _ => (),
      witness: Option[Witness] = None
  ): Rendering =
    require(threads >= 1, s"`threads` must be at least 1, found $threads")
    val started = System.nanoTime
    var paused = 0L
    def seconds = (System.nanoTime - started - paused) * 1e-9

    val samplesPerPixel = plan.sampler.samplesPerPixel
    val job = Job(plan)
    val schedule = job.schedule
    val board = Board(schedule, cancellation)
    val workers = Vector.fill(Math.min(threads.toLong, schedule.steps).toInt)(job.worker(board))

    val total = plan.sampled.pixels * samplesPerPixel
    def progress() = onProgress(Progress(board.samplesTaken.sum, total, seconds))
    for end <- witness.fold(Vector(schedule.waves))(_ => schedule.passes) if !board.isStopped do
      board.openUntil(end)
      val begin = seconds
      Workers.run(workers, board)(() => progress())
      for w <- witness if !board.isStopped do
        val pass = Pass(schedule.firstSample(end), begin, seconds, workers.map(_.seconds))
        val stopped = System.nanoTime
        w.passed(pass, job.film)
        paused += System.nanoTime - stopped
    progress()

    Rendering(
      job.film,
      samplesPerPixel,
      board.samplesDone,
      board.samplesTaken.sum,
      workers.map(_.raysTraced).sum,
      seconds,
      firstOf(workers.flatMap(_.refused)),
      job.layers
    )

  /** Traces a single sample, identical to that of [[render]], and reports its path to `report`.
    *
    * @return its light as accumulated by the film; none if it was discarded
    */
  def trace(plan: RenderPlan, x: Int, y: Int, sample: Int, report: PathReport): Option[Rgb] =
    val (film, worker) = Job.single(plan, x, y, report)
    worker.take(x, y, sample)
    val data = film.toImage(1f).data
    Option.when(worker.refused.isEmpty)(Rgb(data(0), data(1), data(2)))

  private def firstOf(refused: Vector[Refused]): Option[Refused] =
    refused
      .minByOption(r => (r.sample, r.y, r.x))
      .map(_.copy(count = refused.map(_.count).sum))
