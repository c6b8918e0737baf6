package candela.render

import candela.bdpt.Strategies
import candela.caustics.CausticChoice
import candela.color.Wavelengths
import candela.film.{SplatFilm, Splats, View}
import candela.guiding.GuideSettings
import candela.integrators.{ConvertedSplats, Integrator, SpectralIntegrators, WorkerIntegrators}
import candela.scene.{PathReport, Scene}

/** Organisation of an image's samples, selected by the integrator's recipe. What depends on the
  * camera or the film is created for a plan.
  */
abstract class RenderMethod:

  /** Whether the sampler places the camera samples; required for AOVs. */
  def takesCameraSamples: Boolean = true

  /** Whether samples may contribute to all pixels within the filter's radius. Light paths and
    * photons contribute to the pixel that they were started for.
    */
  def canShareSamples: Boolean

  /** Whether samples can be added beyond the planned number. */
  def canKeepOn: Boolean

  /** Whether all light comes with its wavelengths. */
  def hasWavelengths: Boolean = true

  /** Whether its light is divided by way and source, as the scene asks. */
  def dividesLight: Boolean

  /** The strategies of connection that it tells apart, as asked. */
  def strategies: Option[Strategies] = None

  /** Whether light paths connect to the camera. */
  def seesLightPaths: Boolean = false

  /** What its paths learn, if they do: samples then depend on those before. */
  def guide: Option[GuideSettings] = None

  /** What makes the image biased, if the integrator alone would not. */
  def bias: Option[String] = None

  /** Light that it finds although the integrator by its definition doesn't. */
  def addedLight: Option[String] = None

  /** Whether it blurs light, less so with more samples. */
  def blurs: Boolean = false

  /** Why no sample is an outlier of brightness, if so. */
  def withoutOutliers: Option[String] = None

  /** Chooses a method that finds more of the light, for a plan whose camera is known. */
  def pilot: Option[MethodPilot] = None

  /** The method as it is without its pilot. */
  def withoutPilot: RenderMethod = this

  /** Film, schedule and workers. */
  private[render] def job(plan: RenderPlan, shard: Shard): Job

  /** An integrator that traces single samples.
    *
    * @return with it, what begins a sample
    */
  private[render] def single(plan: RenderPlan, report: PathReport): SingleSamples

  /** The same method in spectral rendering.
    *
    * @param parts methods of this class, one for each basis
    */
  private[render] def spectral(
      bases: Array[Wavelengths],
      parts: Vector[RenderMethod]
  ): RenderMethod

/** Integrator of single samples.
  *
  * @param begin given the stopping of a queue, begins each sample
  */
private[render] final case class SingleSamples(
    integrator: Integrator,
    begin: TaskQueue => TileWorker.BeginWave = _ => TileWorker.Unweighted
)

object RenderMethod:
  /** Independent camera samples, whose integrators are made from the scene alone. */
  def tiles(scene: Scene)(integrator: Scene => Integrator): RenderMethod =
    Tiles(WorkerIntegrators(scene)(integrator))

  /** The method of spectral rendering, made of those of the single bases.
    *
    * @param parts of the same class, at least one
    */
  def spectral(parts: Vector[(Wavelengths, RenderMethod)]): RenderMethod =
    parts.head._2.spectral(parts.map(_._1).toArray, parts.map(_._2))

  /** Integrators of several bases, each with the view of its own.
    *
    * @param make of each basis
    */
  private[render] def inBases(
      bases: Array[Wavelengths],
      make: Vector[View => WorkerIntegrators]
  )(view: View): WorkerIntegrators =
    val workers = make.zip(bases).map: (of, basis) =>
      of(view.copy(splats = ConvertedSplats(view.splats, basis)))
    SpectralIntegrators(workers, bases)

  /** Single samples of a plan, without splats. */
  private[render] def single(plan: RenderPlan, report: PathReport)(
      integrators: View => WorkerIntegrators
  ): SingleSamples =
    SingleSamples(integrators(plan.view(Splats.Discarded)).create(Some(report)))

  /** The film of splats. */
  private[render] def splatFilm(plan: RenderPlan): SplatFilm =
    val pixels = plan.width.toDouble * plan.height
    SplatFilm(
      plan.crop,
      plan.filter,
      pixels,
      plan.basis,
      plan.indirectLimit.toVector ++ plan.limit,
      plan.splatGroups,
      plan.bands,
      plan.strategies.count(_.isSplatted)
    )

/** Chooses, by a few paths, a method that finds caustics where that reduces the noise.
  *
  * @param run      decides on light paths or photons, and says why
  * @param method   with these
  * @param connects whether it takes light paths, which connect to the camera, if it may
  * @param blurs    whether it takes nothing but photons, which blur
  */
final class MethodPilot(
    val run: View => (Option[CausticChoice], String),
    val method: CausticChoice => RenderMethod,
    val connects: Boolean,
    val blurs: Boolean
)

object MethodPilot:
  /** Leaves the method as it is, and says why. */
  def unchanged(why: String, alone: RenderMethod): MethodPilot =
    MethodPilot(_ => (None, s"none: $why"), _ => alone, connects = false, blurs = false)

/** A method that renders alone, beside which a pilot may choose a better one. */
final class Piloted(alone: RenderMethod, chooser: MethodPilot) extends RenderMethod:
  override def takesCameraSamples: Boolean = alone.takesCameraSamples
  def canShareSamples: Boolean = alone.canShareSamples
  def canKeepOn: Boolean = alone.canKeepOn
  override def hasWavelengths: Boolean = alone.hasWavelengths
  def dividesLight: Boolean = alone.dividesLight
  override def seesLightPaths: Boolean = alone.seesLightPaths
  override def guide: Option[GuideSettings] = alone.guide
  override def pilot: Option[MethodPilot] = Some(chooser)
  override def withoutPilot: RenderMethod = alone

  private[render] def job(plan: RenderPlan, shard: Shard): Job = alone.job(plan, shard)
  private[render] def single(plan: RenderPlan, report: PathReport): SingleSamples =
    alone.single(plan, report)

  private[render] def spectral(
      bases: Array[Wavelengths],
      parts: Vector[RenderMethod]
  ): RenderMethod =
    val pilots = parts.flatMap(_.pilot)
    // One decides for all: bases differ in colours only
    val decider = pilots(pilots.size / 2)
    Piloted(
      alone.spectral(bases, parts.map(_.withoutPilot)),
      MethodPilot(
        decider.run,
        choice => RenderMethod.spectral(bases.toVector.zip(pilots.map(_.method(choice)))),
        decider.connects,
        decider.blurs
      )
    )
