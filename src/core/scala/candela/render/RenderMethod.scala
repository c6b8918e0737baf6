package candela.render

import candela.bidirectional.{CausticChoice, ChainPaths, SpectralChainPaths}
import candela.color.Wavelengths
import candela.film.{Splats, View}
import candela.guiding.{Guide, GuideSettings}
import candela.integrators.{
  ConvertedSplats, Integrator, SharedChains, SharedPasses, SpectralIntegrators, SpectralPasses,
  WorkerIntegrators
}
import candela.scene.Scene

/** Organisation of an image's samples, selected by the integrator's recipe. Parts that depend on
  * the camera or film are created once these are known. Each method says all that others ask of it.
  *
  * @param takesCameraSamples whether the sampler places the camera samples; required for AOVs
  * @param canShareSamples    whether samples may contribute to all pixels within the filter's
  *                           radius. Light paths and photons contribute to the pixel that they were
  *                           started for
  * @param learns             whether samples depend on those before
  * @param canKeepOn          whether samples can be added beyond the planned number
  * @param hasWavelengths     whether all light comes with its wavelengths
  * @param dividesLight       whether its light is divided by way and source, as the scene asks
  * @param seesLightPaths     whether light paths connect to the camera
  */
enum RenderMethod(
    val takesCameraSamples: Boolean,
    val canShareSamples: Boolean,
    val learns: Boolean,
    val canKeepOn: Boolean,
    val hasWavelengths: Boolean,
    val dividesLight: Boolean,
    val seesLightPaths: Boolean
):

  /** Independent camera samples, tile by tile. */
  case Tiles(integrators: WorkerIntegrators)
      extends RenderMethod(
        takesCameraSamples = true,
        canShareSamples = true,
        learns = false,
        canKeepOn = true,
        hasWavelengths = true,
        dividesLight = integrators.divideLight,
        seesLightPaths = false
      )

  /** Camera samples, tile by tile, whose paths learn from those of earlier passes.
    *
    * @param unguided their integrators, if nothing is learnt
    * @param settings of what is learnt
    * @param guided   learn, and are guided
    */
  case Guided(
      unguided: WorkerIntegrators,
      settings: GuideSettings,
      guided: Guide => WorkerIntegrators
  ) extends RenderMethod(
        takesCameraSamples = true,
        canShareSamples = true,
        learns = true,
        canKeepOn = settings.learnsOn,
        hasWavelengths = true,
        dividesLight = unguided.divideLight,
        seesLightPaths = false
      )

  /** Camera samples, tile by tile; their light paths splat to the whole film.
    *
    * @param beside do light paths find light beside the camera's paths, and weigh it against these?
    *   Else they find a part of it alone
    * @param guided how the camera's paths learn, if they do
    * @param adds   what light they find that the integrator by its definition doesn't, if any
    */
  case SplattedTiles(
      integrators: View => WorkerIntegrators,
      beside: Boolean = false,
      guided: Option[GuidedSplats] = None,
      adds: Option[String] = None
  ) extends RenderMethod(
        takesCameraSamples = true,
        canShareSamples = beside,
        learns = guided.isDefined,
        canKeepOn = guided.forall(_.settings.learnsOn),
        hasWavelengths = true,
        dividesLight = beside,
        seesLightPaths = true
      )

  /** Camera samples, tile by tile; samples of equal number share their pass's precomputation.
    *
    * @param bias of a method that would have none without passes: what makes the image biased
    */
  case Passes(passes: View => SharedPasses, bias: Option[String] = None)
      extends RenderMethod(
        takesCameraSamples = true,
        canShareSamples = false,
        learns = false,
        canKeepOn = false,
        hasWavelengths = true,
        dividesLight = false,
        seesLightPaths = false
      )

  /** Markov chains, which choose film positions themselves.
    *
    * @param paths       the paths that they explore, with their splats
    * @param chains      the chains of such paths
    * @param integrators evaluate a single camera sample without chains
    */
  case Chains(
      paths: (View, Splats) => ChainPaths,
      chains: (View, Splats => ChainPaths) => SharedChains,
      integrators: View => WorkerIntegrators
  ) extends RenderMethod(
        takesCameraSamples = false,
        canShareSamples = false,
        learns = false,
        canKeepOn = false,
        hasWavelengths = false,
        dividesLight = false,
        seesLightPaths = true
      )

  /** A method to be chosen once the camera is known, before the plan is made.
    *
    * @param alone    without light paths
    * @param pilot    decides on them, and says why
    * @param chosen   with light paths
    * @param connects are they connected to the camera?
    */
  case Piloted(
      alone: RenderMethod,
      pilot: View => (Option[CausticChoice], String),
      chosen: CausticChoice => RenderMethod,
      connects: Boolean = true
  ) extends RenderMethod(
        alone.takesCameraSamples,
        alone.canShareSamples,
        alone.learns,
        alone.canKeepOn,
        alone.hasWavelengths,
        alone.dividesLight,
        alone.seesLightPaths
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

object RenderMethod:
  /** Independent camera samples, whose integrators are made from the scene alone. */
  def tiles(scene: Scene)(integrator: Scene => Integrator): RenderMethod =
    Tiles(WorkerIntegrators(scene)(integrator))

  /** The method of spectral rendering, made of those of the single bases.
    *
    * @param parts of the same kind, at least one
    */
  def spectral(parts: Vector[(Wavelengths, RenderMethod)]): RenderMethod =
    val bases = parts.map(_._1).toArray
    val methods = parts.map(_._2)
    def converted(view: View, basis: Wavelengths) =
      view.copy(splats = ConvertedSplats(view.splats, basis))
    def ofView(integrators: Vector[View => WorkerIntegrators])(view: View): WorkerIntegrators =
      val workers = integrators.zip(bases).map((make, basis) => make(converted(view, basis)))
      SpectralIntegrators(workers, bases)
    methods.head match
      case Tiles(_) =>
        Tiles(SpectralIntegrators(methods.collect { case Tiles(i) => i }, bases))
      case Guided(_, settings, _) =>
        val perBasis = methods.collect { case g: Guided => g }
        Guided(
          SpectralIntegrators(perBasis.map(_.unguided), bases),
          settings,
          shared => SpectralIntegrators(perBasis.map(_.guided(shared)), bases)
        )
      case SplattedTiles(_, beside, learning, adds) =>
        val perBasis = methods.collect { case s: SplattedTiles => s }
        def guided(view: View, guide: Guide) =
          val workers = perBasis.zip(bases).map: (of, basis) =>
            of.guided.get.integrators(converted(view, basis), guide)
          SpectralIntegrators(workers, bases)
        SplattedTiles(
          ofView(perBasis.map(_.integrators)),
          beside,
          learning.map(s => GuidedSplats(s.settings, guided)),
          adds
        )
      case Piloted(_, _, _, connects) =>
        val perBasis = methods.collect { case p: Piloted => p }
        // One decides for all: bases differ in colours only
        val decider = perBasis(perBasis.size / 2)
        Piloted(
          spectral(parts.map(_._1).zip(perBasis.map(_.alone))),
          decider.pilot,
          choice => spectral(parts.map(_._1).zip(perBasis.map(_.chosen(choice)))),
          connects
        )
      case Passes(_, bias) =>
        val perBasis = methods.collect { case Passes(make, _) => make }
        Passes(view => SpectralPasses(perBasis.map(_(view)), bases), bias)
      case Chains(_, chains, _) =>
        val perBasis = methods.collect { case Chains(paths, _, single) => (paths, single) }
        def paths(view: View, splats: Splats) =
          val chainPaths = perBasis.zip(bases).map: (of, basis) =>
            of._1(view, ConvertedSplats(splats, basis))
          SpectralChainPaths(chainPaths.toArray, bases)
        Chains(paths, chains, ofView(perBasis.map(_._2)))
