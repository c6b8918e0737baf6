package candela.render

import candela.bdpt.{ChainPaths, SpectralChainPaths}
import candela.color.Wavelengths
import candela.film.{Splats, View}
import candela.integrators.{
  ConvertedSplats, PassIntegrator, SharedChains, SharedPasses, SpectralPasses,
  WorkerIntegrators
}
import candela.scene.PathReport

/** Camera samples, tile by tile; samples of equal number share their pass's precomputation.
  *
  * @param bias of a method that would have none without passes: what makes the image biased
  */
final class Passes(
    private val passes: View => SharedPasses,
    override val bias: Option[String] = None
) extends RenderMethod:
  def canShareSamples: Boolean = false
  def canKeepOn: Boolean = false
  def dividesLight: Boolean = false
  override def blurs: Boolean = true
  override def withoutOutliers: Option[String] = Some(Passes.WithoutOutliers)

  private[render] def job(plan: RenderPlan, shard: Shard): Job =
    val shared = passes(plan.view(Splats.Discarded))
    val schedule = TileSchedule(
      plan.sampled,
      plan.samplesPerPixel,
      largestWave = 1,
      openWaves = SharedPasses.MaxOpen
    )
    val tiles = TileJobs(plan, schedule, (_, sample) => shard.takesPass(sample))
    tiles.jobOf: queue =>
      val integrator = shared.integrator(None)
      tiles.worker(integrator, queue, beginWave(integrator, queue))

  private[render] def single(plan: RenderPlan, report: PathReport): SingleSamples =
    val integrator = passes(plan.view(Splats.Discarded)).integrator(Some(report))
    SingleSamples(integrator, beginWave(integrator, _))

  /** Begins waves of a pass; all samples count the same. */
  private def beginWave(integrator: PassIntegrator, queue: TaskQueue): TileWorker.BeginWave =
    (pass, _) =>
      if integrator.startPass(pass, () => queue.isStopped) then 1f else TileWorker.Stopped

  private[render] def spectral(
      bases: Array[Wavelengths],
      parts: Vector[RenderMethod]
  ): RenderMethod =
    val methods = parts.collect { case p: Passes => p }
    Passes(view => SpectralPasses(methods.map(_.passes(view)), bases), bias)

object Passes:
  /** What is said of guiding where photons bring caustics. */
  val Unguided: String = "paths that take caustics from photons are not guided"

  /** Why no sample is an outlier of brightness. */
  val WithoutOutliers: String =
    "a photon brightens many samples alike, none of which is an outlier"

/** Markov chains, which choose film positions themselves.
  *
  * @param paths       the paths that they explore, with their splats
  * @param chains      the chains of such paths
  * @param integrators evaluate a single camera sample without chains
  */
final class Chains(
    private val paths: (View, Splats) => ChainPaths,
    chains: (View, Splats => ChainPaths) => SharedChains,
    private val integrators: View => WorkerIntegrators
) extends RenderMethod:
  override def takesCameraSamples: Boolean = false
  def canShareSamples: Boolean = false
  def canKeepOn: Boolean = false
  override def hasWavelengths: Boolean = false
  def dividesLight: Boolean = false
  override def seesLightPaths: Boolean = true
  override def withoutOutliers: Option[String] =
    Some("Markov chains visit light by its brightness: no sample is too bright")

  private[render] def job(plan: RenderPlan, shard: Shard): Job =
    val splats = RenderMethod.splatFilm(plan)
    val view = plan.view(splats)
    val sharedChains = chains(view, paths(view, _))
    val schedule = ChainSchedule(sharedChains.count, plan.crop.pixels, plan.samplesPerPixel, shard)
    new Job(
      schedule,
      Job.film(plan.crop, Some(splats)),
      layers = None,
      Some(sharedChains),
      guide = None,
      ChainWorker(sharedChains.walker(), schedule, _)
    )

  private[render] def single(plan: RenderPlan, report: PathReport): SingleSamples =
    RenderMethod.single(plan, report)(integrators)

  private[render] def spectral(
      bases: Array[Wavelengths],
      parts: Vector[RenderMethod]
  ): RenderMethod =
    val methods = parts.collect { case c: Chains => c }
    Chains(
      (view, splats) =>
        val ofBases = methods.zip(bases).map: (of, basis) =>
          of.paths(view, ConvertedSplats(splats, basis))
        SpectralChainPaths(ofBases.toArray, bases)
      ,
      chains,
      RenderMethod.inBases(bases, methods.map(_.integrators))
    )
