package candela.render

import candela.bdpt.Strategies
import candela.color.Wavelengths
import candela.film.{Fireflies, SplatFilm, View}
import candela.guiding.{Guide, GuideSettings}
import candela.integrators.{SpectralIntegrators, WorkerIntegrators}
import candela.scene.PathReport

/** Independent camera samples, tile by tile. */
final class Tiles(val integrators: WorkerIntegrators) extends RenderMethod:
  def canShareSamples: Boolean = true
  def canKeepOn: Boolean = true
  def dividesLight: Boolean = integrators.divideLight

  private[render] def job(plan: RenderPlan, shard: Shard): Job =
    val samples = plan.samplesPerPixel
    val atOnce = if plan.adaptive.isDefined then samples else 1
    TileJobs(plan, TileSchedule(plan.sampled, samples, atOnce = atOnce), shard.takesTile)
      .job(integrators)

  private[render] def single(plan: RenderPlan, report: PathReport): SingleSamples =
    SingleSamples(integrators.create(Some(report)))

  private[render] def spectral(
      bases: Array[Wavelengths],
      parts: Vector[RenderMethod]
  ): RenderMethod =
    Tiles(SpectralIntegrators(parts.collect { case t: Tiles => t.integrators }, bases))

/** Camera samples, tile by tile, whose paths learn from those of earlier passes.
  *
  * @param unguided their integrators, if nothing is learnt
  * @param settings of what is learnt
  * @param guided   learn, and are guided
  */
final class GuidedTiles(
    private val unguided: WorkerIntegrators,
    settings: GuideSettings,
    private val guided: Guide => WorkerIntegrators
) extends RenderMethod:
  def canShareSamples: Boolean = true
  def canKeepOn: Boolean = settings.learnsOn
  def dividesLight: Boolean = unguided.divideLight
  override def guide: Option[GuideSettings] = Some(settings)

  private[render] def job(plan: RenderPlan, shard: Shard): Job =
    GuidedTiles.job(plan, shard, settings, guided, None)

  private[render] def single(plan: RenderPlan, report: PathReport): SingleSamples =
    SingleSamples(unguided.create(Some(report)))

  private[render] def spectral(
      bases: Array[Wavelengths],
      parts: Vector[RenderMethod]
  ): RenderMethod =
    val guides = parts.collect { case g: GuidedTiles => g }
    GuidedTiles(
      SpectralIntegrators(guides.map(_.unguided), bases),
      settings,
      shared => SpectralIntegrators(guides.map(_.guided(shared)), bases)
    )

object GuidedTiles:
  private[render] def job(
      plan: RenderPlan,
      shard: Shard,
      settings: GuideSettings,
      guided: Guide => WorkerIntegrators,
      splats: Option[SplatFilm]
  ): Job =
    val samples = plan.samplesPerPixel
    val schedule = TileSchedule(plan.sampled, samples, openWaves = 1)
    // Fireflies are told from other samples by how many there are of each brightness
    val weighted = settings.copy(weighs = plan.fireflies != Fireflies.Reweighted)
    val guide = Guide(weighted, samples, plan.sampled.pixels)
    val beginWave: TaskQueue => TileWorker.BeginWave = queue =>
      (sample, moves) =>
        if guide.beginSample(sample, moves, () => queue.isAbandoned) then guide.weight
        else TileWorker.Stopped
    TileJobs(plan, schedule, shard.takesTile, splats, Some(guide)).job(guided(guide), beginWave)

/** Camera samples, tile by tile; their light paths splat to the whole film.
  *
  * @param beside     do light paths find light beside the camera's paths, and weigh it against
  *                   these? Else they find a part of it alone
  * @param guided     how the camera's paths learn, if they do
  * @param addedLight what light they find that the integrator by its definition doesn't, if any
  */
final class SplattedTiles(
    private val integrators: View => WorkerIntegrators,
    val beside: Boolean = false,
    private val guided: Option[GuidedSplats] = None,
    override val addedLight: Option[String] = None,
    override val strategies: Option[Strategies] = None
) extends RenderMethod:
  def canShareSamples: Boolean = beside
  def canKeepOn: Boolean = guided.forall(_.settings.learnsOn)
  def dividesLight: Boolean = beside
  override def seesLightPaths: Boolean = true
  override def guide: Option[GuideSettings] = guided.map(_.settings)

  private[render] def job(plan: RenderPlan, shard: Shard): Job =
    val splats = RenderMethod.splatFilm(plan)
    val view = plan.view(splats)
    guided match
      case Some(g) => GuidedTiles.job(plan, shard, g.settings, g.integrators(view, _), Some(splats))
      case None =>
        val schedule = TileSchedule(plan.sampled, plan.samplesPerPixel)
        TileJobs(plan, schedule, shard.takesTile, Some(splats)).job(integrators(view))

  private[render] def single(plan: RenderPlan, report: PathReport): SingleSamples =
    RenderMethod.single(plan, report)(integrators)

  private[render] def spectral(
      bases: Array[Wavelengths],
      parts: Vector[RenderMethod]
  ): RenderMethod =
    val methods = parts.collect { case s: SplattedTiles => s }
    def guidedBy(guide: Guide) = methods.flatMap(_.guided).map(g => g.integrators(_, guide))
    SplattedTiles(
      RenderMethod.inBases(bases, methods.map(_.integrators)),
      beside,
      guided.map(g =>
        GuidedSplats(
          g.settings,
          (view, guide) => RenderMethod.inBases(bases, guidedBy(guide))(view)
        )
      ),
      addedLight,
      strategies
    )

/** How paths beside light paths learn.
  *
  * @param settings    of what is learnt
  * @param integrators learn, and are guided
  */
final case class GuidedSplats(
    settings: GuideSettings,
    integrators: (View, Guide) => WorkerIntegrators
)
