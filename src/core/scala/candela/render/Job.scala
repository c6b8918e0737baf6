package candela.render

import candela.aov.*
import candela.film.*
import candela.guiding.{Guide, GuideSettings}
import candela.integrators.{
  Integrator, PassIntegrator, SharedChains, SharedPasses, WorkerIntegrators
}
import candela.scene.PathReport

/** Film, schedule and workers of a plan's method, each created once. */
private[render] final class Job(
    val schedule: Schedule,
    val film: Film,
    val layers: Option[LayerFilm],
    val chains: Option[SharedChains],
    val guide: Option[Guide],
    val worker: TaskQueue => Worker
):
  /** Whether a piece can have been left so. */
  def isBegun(piece: Int, begun: BegunPiece): Boolean =
    val isPiece = piece >= 0 && piece < schedule.pieces && begun.done > 0
    isPiece && (schedule match
      case tiled: TileSchedule =>
        begun.done < tiled.tiles(piece).pixels &&
        begun.sums.length == film.shares.fold(0)(_.size(piece))
      case _ =>
        begun.done < ChainWorker.AtOnce && begun.sums.length == 1 &&
        begun.sums(0) >= 0 && begun.sums(0).toFloat < Float.PositiveInfinity)

  /** Completes the film of a rendering that ends and is not continued from here. */
  def settle(queue: TaskQueue): Unit =
    for all <- chains do
      queue.begun.forEach((chain, begun) => all.settle(chain, begun.sums(0).toFloat))

private[render] object Job:

  def apply(plan: RenderPlan, shard: Shard): Job =
    val samples = plan.samplesPerPixel
    plan.method match
      case RenderMethod.Tiles(integrators) =>
        val tiles = TileJobs(plan, TileSchedule(plan.sampled, samples), plan.crop, shard.takes)
        tiles.job(tiles.worker(integrators.make(None), _))
      case RenderMethod.Guided(_, settings, guided) =>
        guidedJob(plan, shard, settings, guided, None)
      case RenderMethod.SplattedTiles(_, _, Some(guided), _) =>
        val splats = splatFilm(plan)
        val view = plan.view(splats)
        guidedJob(plan, shard, guided.settings, guided.integrators(view, _), Some(splats))
      case RenderMethod.SplattedTiles(make, _, None, _) =>
        val splats = splatFilm(plan)
        val integrators = make(plan.view(splats))
        val tiles =
          TileJobs(plan, TileSchedule(plan.sampled, samples), plan.crop, shard.takes, Some(splats))
        tiles.job(tiles.worker(integrators.make(None), _))
      case _: RenderMethod.Piloted => unchosen()
      case RenderMethod.Passes(make, _) =>
        val passes = make(plan.view(Splats.Discarded))
        val schedule = TileSchedule(
          plan.sampled,
          samples,
          largestWave = 1,
          openWaves = SharedPasses.MaxOpen
        )
        val takes = (_: Int, sample: Int) => shard.takesPass(sample)
        val tiles = TileJobs(plan, schedule, plan.crop, takes)
        tiles.job: queue =>
          val integrator = passes.integrator(None)
          tiles.worker(integrator, queue, begin(integrator, queue))
      case RenderMethod.Chains(paths, make, _) =>
        val splats = splatFilm(plan)
        val view = plan.view(splats)
        val chains = make(view, paths(view, _))
        val schedule = ChainSchedule(chains.count, plan.crop.pixels, samples, shard)
        val film = filmOf(plan.crop, Some(splats))
        def worker(queue: TaskQueue) =
          ChainWorker(chains.walker(), schedule, queue)
        new Job(schedule, film, layers = None, Some(chains), guide = None, worker)

  private def guidedJob(
      plan: RenderPlan,
      shard: Shard,
      asked: GuideSettings,
      guided: Guide => WorkerIntegrators,
      splats: Option[SplatFilm]
  ): Job =
    val samples = plan.samplesPerPixel
    val schedule = TileSchedule(plan.sampled, samples, openWaves = 1)
    // Fireflies are told from other samples by how many there are of each brightness
    val settings = asked.copy(weighs = plan.fireflies != Fireflies.Reweighted)
    val guide = Guide(settings, samples, plan.sampled.pixels)
    val tiles = TileJobs(plan, schedule, plan.crop, shard.takes, splats, guide = Some(guide))
    val integrators = guided(guide)
    tiles.job: queue =>
      tiles.worker(integrators.make(None), queue, begin(guide, queue))

  /** Traces a single sample of one pixel; `report` receives its path. */
  def single(plan: RenderPlan, x: Int, y: Int, report: PathReport): (Film, TileWorker) =
    val pixel = PixelBounds(x, y, x + 1, y + 1)
    val schedule = TileSchedule(pixel, plan.sampler.samplesPerPixel)
    val tiles = TileJobs(plan, schedule, pixel, (_, _) => true, isSingle = true)
    val queue = TaskQueue(schedule, Cancellation())
    val view = plan.view(Splats.Discarded)
    def worker(integrators: WorkerIntegrators) = tiles.worker(integrators.make(Some(report)), queue)
    val tileWorker = plan.method match
      case RenderMethod.Tiles(integrators) => worker(integrators)
      case RenderMethod.Guided(unguided, _, _) => worker(unguided)
      case RenderMethod.SplattedTiles(make, _, _, _) => worker(make(view))
      case _: RenderMethod.Piloted => unchosen()
      case RenderMethod.Chains(_, _, make) => worker(make(view))
      case RenderMethod.Passes(make, _) =>
        val integrator = make(view).integrator(Some(report))
        tiles.worker(integrator, queue, begin(integrator, queue))
    (tiles.film, tileWorker)

  private def unchosen(): Nothing =
    throw IllegalArgumentException("the method has not been chosen")

  /** Begins waves of samples, with their weights. */
  private def begin(guide: Guide, queue: TaskQueue): TileWorker.BeginWave = (sample, moves) =>
    if guide.begin(sample, moves, () => queue.isAbandoned) then guide.weight
    else TileWorker.Stopped

  /** Begins waves of a pass; all samples count the same. */
  private def begin(integrator: PassIntegrator, queue: TaskQueue): TileWorker.BeginWave =
    (pass, _) =>
      if integrator.begin(pass, () => queue.isStopped) then 1f else TileWorker.Stopped

  private def filmOf(
      b: PixelBounds,
      splats: Option[SplatFilm],
      shares: Option[SampleShares] = None,
      bands: Option[BandFilm] = None,
      levels: Option[BrightnessLevels] = None,
      volume: Double = 1
  ): Film = Film(b.x0, b.y0, b.x1, b.y1, splats, shares, bands, levels, volume)

  private def splatFilm(plan: RenderPlan): SplatFilm =
    val PixelBounds(x0, y0, x1, y1) = plan.crop
    val pixels = plan.width.toDouble * plan.height
    val groups = plan.layers.filter(_.layers.contains(Layer.Lights)).flatMap(_.groups)
    SplatFilm(
      x0,
      y0,
      x1,
      y1,
      plan.filter,
      pixels,
      plan.basis,
      plan.indirectLimit.toVector ++ plan.limit,
      groups.fold(1)(_.size),
      plan.bands
    )

  /** Common base of the tiled methods. */
  private final class TileJobs(
      plan: RenderPlan,
      schedule: TileSchedule,
      bounds: PixelBounds,
      takes: (Int, Int) => Boolean,
      splats: Option[SplatFilm] = None,
      isSingle: Boolean = false,
      guide: Option[Guide] = None
  ):
    private val PixelBounds(x0, y0, x1, y1) = bounds
    private val shares = Option.when(plan.sharesSamples):
      SampleShares(x0, y0, x1, y1, FilterReach(plan.filter), schedule.tiles)
    val film: Film = filmOf(
      bounds,
      splats,
      shares,
      plan.bands.map(BandFilm(_, x0, y0, x1, y1)),
      Option.when(plan.fireflies == Fireflies.Reweighted && !isSingle):
        BrightnessLevels(shares.fold(schedule.tiles)(_.reached))
      ,
      if plan.sharesSamples then plan.filter.integral else 1
    )
    private val layers =
      plan.layers.map(asked => LayerFilm(x0, y0, x1, y1, asked.layers, asked.groups))
    private val filterSampler =
      new FilterSampler(if plan.isCentered then BoxFilter(0.5f, 0.5f) else plan.filter)

    def job(worker: TaskQueue => Worker): Job =
      new Job(schedule, film, layers, chains = None, guide, worker)

    def worker(
        integrator: Integrator,
        queue: TaskQueue,
        beginWave: TileWorker.BeginWave = TileWorker.Unweighted
    ): TileWorker =
      TileWorker(
        plan, schedule, queue, film, layers, filterSampler.copy(), integrator, takes, beginWave
      )
