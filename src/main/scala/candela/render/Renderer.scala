package candela.render

import candela.color.Rgb
import candela.film.{Film, FilterReach, FilterSampler, LayerFilm, SampleShares, SplatFilm}
import candela.integrators.{Chained, Splatting, Stepping, View}
import candela.scene.PathReport

/** Turns a plan into an image. */
object Renderer:

  /** Renders with `threads` workers. The image depends on the plan alone, bit for bit: a pixel is
    * in one tile, whose samples are added in the order of their numbers, whoever does it.
    *
    * @param onProgress called about ten times a second, and at the end, in the caller's thread
    * @param witness    who sees the image grow; the image is the same with and without
    * @throws RenderFailure if a sample fails; all workers then stop
    */
  def render(
      plan: RenderPlan,
      threads: Int,
      cancellation: Cancellation = Cancellation(),
      onProgress: Progress => Unit = _ => (),
      witness: Option[Witness] = None
  ): Rendering =
    require(threads >= 1, s"$threads threads")
    val started = System.nanoTime
    var paused = 0L
    def seconds = (System.nanoTime - started - paused) * 1e-9

    val samplesPerPixel = plan.sampler.samplesPerPixel
    val PixelBounds(x0, y0, x1, y1) = plan.crop
    val splats = plan.integrator match
      case _: Splatting =>
        Some(
          SplatFilm(
            x0,
            y0,
            x1,
            y1,
            plan.filter,
            plan.width.toDouble * plan.height,
            plan.basis,
            plan.limit
          )
        )
      case _ => None
    val film = Film(x0, y0, x1, y1, splats, shares(plan, plan.crop, plan.sampled))
    val layers = plan.layers.map(asked => LayerFilm(x0, y0, x1, y1, asked.layers))
    val (schedule, board, workers) = crew(plan, threads, cancellation, film, layers)

    val total = plan.sampled.pixels * samplesPerPixel
    def progress() = onProgress(Progress(board.samplesTaken.sum, total, seconds))
    for end <- witness.fold(Vector(schedule.waves))(_ => schedule.passes) if !board.isStopped do
      board.openUntil(end)
      val begin = seconds
      Workers.run(workers, board)(() => progress())
      for w <- witness if !board.isStopped do
        val pass = Pass(schedule.firstSample(end), begin, seconds, workers.map(_.seconds))
        val stopped = System.nanoTime
        w.passed(pass, film)
        paused += System.nanoTime - stopped
    progress()

    Rendering(
      film,
      samplesPerPixel,
      board.samplesDone,
      board.samplesTaken.sum,
      workers.map(_.raysTraced).sum,
      seconds,
      firstOf(workers.flatMap(_.refused)),
      layers
    )

  private def crew(
      plan: RenderPlan,
      threads: Int,
      cancellation: Cancellation,
      film: Film,
      layers: Option[LayerFilm]
  ): (Waves, Board, Vector[Worker]) =
    def workers(waves: Waves)(worker: Board => Worker) =
      val board = Board(waves, cancellation)
      (waves, board, Vector.fill(Math.min(threads.toLong, waves.steps).toInt)(worker(board)))
    val samples = plan.sampler.samplesPerPixel
    (plan.integrator, film.splats) match
      case (chained: Chained, Some(splats)) =>
        val chains = chained.chains(view(plan, splats))
        val waves = Waves(chains.count, samples)
        workers(waves)(ChainWorker(chains.walker(), waves, _, plan.crop.pixels))
      case (integrator, _) =>
        val largest = integrator match
          case _: Stepping => 1
          case _ => Waves.Largest
        val filterSampler = new FilterSampler(plan.filter)
        val schedule = Schedule(plan.sampled, samples, largest)
        workers(schedule)(TileWorker(plan, schedule, _, film, layers, filterSampler.copy()))

  /** Accumulators of samples that contribute to several pixels; None if the plan has none. */
  private def shares(
      plan: RenderPlan,
      film: PixelBounds,
      sampled: PixelBounds
  ): Option[SampleShares] =
    Option.when(plan.sharesSamples):
      val tiles = Schedule.tilesOf(sampled).map(t => SampleShares.Tile(t.x0, t.y0, t.x1, t.y1))
      SampleShares(film.x0, film.y0, film.x1, film.y1, FilterReach(plan.filter), tiles)

  /** All places of the film that can add to a pixel. */
  private def view(plan: RenderPlan, splats: SplatFilm): View =
    val (beyondX, beyondY) = (plan.filter.radiusX - 0.5f, plan.filter.radiusY - 0.5f)
    View(
      plan.camera,
      splats,
      plan.crop.x0 - beyondX,
      plan.crop.y0 - beyondY,
      plan.crop.x1 + beyondX,
      plan.crop.y1 + beyondY,
      plan.width.toDouble * plan.height,
      plan.shutter,
      plan.differentialScale
    )

  /** Takes one sample by itself, the very one that [[render]] takes, and tells `report` what
    * happens to it.
    *
    * @return how the film has it: its light, or none if it was refused
    */
  def trace(plan: RenderPlan, x: Int, y: Int, sample: Int, report: PathReport): Option[Rgb] =
    val bounds = PixelBounds(x, y, x + 1, y + 1)
    val schedule = Schedule(bounds, plan.sampler.samplesPerPixel)
    val film = Film(x, y, x + 1, y + 1, shares = shares(plan, bounds, bounds))
    val layers = None
    val worker = TileWorker(
      plan,
      schedule,
      Board(schedule, Cancellation()),
      film,
      layers,
      new FilterSampler(plan.filter),
      Some(report)
    )
    worker.take(x, y, sample)
    val data = film.toImage(1f).data
    Option.when(worker.refused.isEmpty)(Rgb(data(0), data(1), data(2)))

  private def firstOf(refused: Vector[Refused]): Option[Refused] =
    refused
      .minByOption(r => (r.sample, r.y, r.x))
      .map(_.copy(count = refused.map(_.count).sum))
