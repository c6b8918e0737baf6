package candela.render

import candela.aov.*
import candela.film.*
import candela.guiding.Guide
import candela.integrators.{Integrator, SharedChains, WorkerIntegrators}
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
        begun.done < tiled.tiles(piece).pixels * tiled.atOnce &&
        begun.sums.length == film.shares.fold(0)(_.size(piece))
      case _ =>
        begun.done < ChainWorker.AtOnce && begun.sums.length == 1 &&
        begun.sums(0) >= 0 && begun.sums(0).toFloat < Float.PositiveInfinity)

private[render] object Job:

  /** Traces a single sample of one pixel; `report` receives its path. */
  def single(plan: RenderPlan, x: Int, y: Int, report: PathReport): (Film, TileWorker) =
    val pixel = PixelBounds(x, y, x + 1, y + 1)
    val schedule = TileSchedule(pixel, plan.sampler.samplesPerPixel)
    val tiles = TileJobs(plan, schedule, (_, _) => true, bounds = Some(pixel))
    val queue = TaskQueue(schedule, Cancellation())
    val samples = plan.method.single(plan, report)
    (tiles.film, tiles.worker(samples.integrator, queue, samples.begin(queue)))

  def film(
      bounds: PixelBounds,
      splats: Option[SplatFilm],
      shares: Option[SampleShares] = None,
      bands: Option[BandFilm] = None,
      levels: Option[BrightnessLevels] = None,
      volume: Double = 1
  ): Film = Film(bounds, splats, shares, bands, levels, volume)

/** Film and workers of the tiled methods.
  *
  * @param takes  whether to take this sample of this tile
  * @param bounds of a film of single samples; none: the plan's
  */
private[render] final class TileJobs(
    plan: RenderPlan,
    schedule: TileSchedule,
    takes: (Int, Int) => Boolean,
    splats: Option[SplatFilm] = None,
    guide: Option[Guide] = None,
    bounds: Option[PixelBounds] = None
):
  private val filmBounds = bounds.getOrElse(plan.crop)
  private val shares = Option.when(plan.sharesSamples):
    SampleShares(filmBounds, FilterReach(plan.filter), schedule.tiles)
  val film: Film = Job.film(
    filmBounds,
    splats,
    shares,
    plan.bands.map(BandFilm(_, filmBounds)),
    Option.when(plan.fireflies == Fireflies.Reweighted && bounds.isEmpty):
      BrightnessLevels(shares.fold(schedule.tiles)(_.reached))
    ,
    if plan.sharesSamples then plan.filter.integral else 1
  )
  private val layers =
    plan.layers.map(asked => LayerFilm(filmBounds, asked.layers, asked.groups))
  private val filterSampler =
    new FilterSampler(if plan.isCentered then BoxFilter(0.5f, 0.5f) else plan.filter)

  /** @param begin begins waves of samples, with their weights */
  def job(
      integrators: WorkerIntegrators,
      begin: TaskQueue => TileWorker.BeginWave = _ => TileWorker.Unweighted
  ): Job = jobOf(queue => worker(integrators.create(None), queue, begin(queue)))

  def jobOf(worker: TaskQueue => Worker): Job =
    new Job(schedule, film, layers, chains = None, guide, worker)

  def worker(
      integrator: Integrator,
      queue: TaskQueue,
      beginWave: TileWorker.BeginWave
  ): TileWorker =
    TileWorker(
      plan, schedule, queue, film, layers, filterSampler.copy(), integrator, takes, beginWave
    )
