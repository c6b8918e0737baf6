package candela.build.integrators

import candela.bdpt.{BidirectionalPathTracer, LightTracer, PathMedia, Strategies}
import candela.diagnostics.Code
import candela.mlt.{MarkovChains, MetropolisSettings}
import candela.photons.{PhotonPasses, PhotonSettings}
import candela.build.recipe.*
import candela.film.{Splats, View}
import candela.integrators.{
  Interfaces, PathLimits, PathTracer, VolumePathTracer, PathOptions, WorkerIntegrators
}
import candela.integrators.LightTransport.{RouletteDepth, SubpathRouletteDepth}
import candela.media.SceneMedia
import candela.render.{Chains, Passes, RenderMethod, SplattedTiles}
import candela.scene.Scene
import candela.scenefile.Dialect

/** Bidirectional path tracing. */
object BdptRecipe extends IntegratorRecipe("bdpt", "bidirectional path tracing", sinceV3)
    with Windowed
    with Regularizing:
  private val unweighted = bool(
    "visualizestrategies",
    "also write an image of each connection strategy, as if it were the only one: of IMAGE.exr, " +
      "IMAGE_bdpt_dDD_sSS_tTT.exr, where light paths of SS and camera paths of TT vertices have " +
      s"DD scattering events, at most $StrategyDepth"
  )(false)
  private val weighted = bool(
    "visualizeweights",
    "likewise, with the weights of multiple importance sampling: these images add up to the image"
  )(false)
  noMeaning("all strategies have the same mean; light subpaths start by power")(
    string("lightsamplestrategy", "light sampling strategy: uniform, power, spatial", onlyV3)(
      "power"
    )
  )

  protected def create()(using site: Site): IntegratorPlan =
    val isShown = unweighted() || weighted()
    val depth = if isShown then Math.min(maxDepth(), StrategyDepth) else maxDepth()
    if depth < maxDepth() then
      site.warn(
        Code.AsInPbrt,
        s"paths have at most $StrategyDepth scattering events where strategies are told apart, " +
          "as in pbrt"
      )
    val strategies = Option.when(isShown)(Strategies(depth, weighted()))
    windowed(BidirectionalPlans.plan(name, depth, regularize(), strategies))

  /** Scattering events of paths whose strategies are told apart, at most. */
  private inline val StrategyDepth = 5

private[build] object MetropolisRanges:
  val Counts: Range = Range(1f, 1e8f)

object MltRecipe
    extends IntegratorRecipe(
      "mlt",
      "Metropolis light transport with bidirectional paths",
      sinceV3
    )
    with Regularizing:
  private val bootstrap = integer(
    "bootstrapsamples",
    "minimum number of bootstrap paths; more are traced until the brightness has a standard " +
      "error of 0.3 %, or until there are as many as mutations",
    range = MetropolisRanges.Counts
  )(100000)
  private val chains = integer("chains", "Markov chains", range = MetropolisRanges.Counts)(1000)
  private val mutations = integer(
    "mutationsperpixel",
    "path mutations per pixel",
    range = MetropolisRanges.Counts
  )(100)
  private val largeStep = float(
    "largestepprobability",
    "probability of an independent path",
    range = Range(0f, 1f)
  )(0.3f)
  private val sigma = float("sigma", "standard deviation of small mutations")(0.01f)

  protected def create()(using Site): IntegratorPlan =
    val settings = MetropolisSettings(bootstrap(), chains(), largeStep(), sigma())
    BidirectionalPlans.metropolis(name, maxDepth(), mutations(), settings, regularize())

object SppmRecipe extends IntegratorRecipe("sppm", "progressive photon mapping", sinceV3):
  private val passes = integer(
    "numiterations",
    "photon passes",
    onlyV3,
    range = Range.atLeast(1f).limited
  )(64)
  private val passesToo = integer(
    "iterations",
    "alias of `numiterations`",
    onlyV3,
    shown = "numiterations"
  )(-1)
  private val photons =
    integer("photonsperiteration", "light paths per pass", shown = "one per pixel")(-1)
  private val radius =
    float(
      "radius",
      "initial search radius for photons",
      unit = "scene units",
      range = PhotonPlans.Radius
    )(1f)
  private val seed =
    integer("seed", "random seed", onlyV4, shown = "the option's")(0)
  noMeaning("the image is written once, at the end")(
    integer(
      "imagewritefrequency",
      "passes between written images",
      onlyV3,
      shown = "never"
    )(Int.MaxValue)
  )

  protected def create()(using site: Site): IntegratorPlan =
    val passCount = if passesToo() > 0 then passesToo() else passes()
    // In v4 the sampler sets the number of passes
    val count = Option.when(site.dialect == Dialect.V3)(passCount)
    val settings =
      PhotonSettings(radius(), photons(), maxDepth(), compresses = true, seed())
    PhotonPlans.plan(name, maxDepth(), settings, count)

object LightPathRecipe
    extends IntegratorRecipe(
      "lightpath",
      "light tracing only: what is seen in mirrors and through smooth glass is black, and so is " +
        "the sky",
      onlyV4
    ):
  protected def create()(using site: Site): IntegratorPlan =
    val depth = maxDepth()
    val passes = site.rules.passes
    IntegratorPlan(
      (scene, _) =>
        SplattedTiles: v =>
          WorkerIntegrators(scene):
            LightTracer(_, v.camera, v.splats, depth, passes, showsSky = passes)
      ,
      samplesBsdf = false,
      s"$name, up to $depth scattering events",
      interfaces = Interfaces.Closed,
      hasVeils = passes
    )

object FunctionRecipe
    extends Recipe[IntegratorPlan]("function", "error of samplers; renders no image", onlyV4)
    with PathInstead:
  override def substitute: Option[String] =
    Some(
      "using \"path\", which renders an image of the scene; `candela bench` measures how the " +
        "error of samplers falls"
    )
  declare(
    oneOf(
      "function",
      "integrand",
      Vector("step", "diagonal", "disk", "checkerboard", "rotatedcheckerboard", "gaussian")
    )("step"),
    string("filename", "file for the errors", shown = "function-mse.txt")(""),
    bool("skipbad", "skip sample counts unsuited to the sampler")(true),
    string("imagefilename", "file for an image of the function", shown = "none")("")
  )

/** Plans that use [[BidirectionalPathTracer]]. */
private[build] object BidirectionalPlans:

  /** @param name name of the integrator in the scene */
  def plan(
      name: String,
      depth: Int,
      regularizes: Boolean = false,
      strategies: Option[Strategies] = None
  )(using site: Site): IntegratorPlan =
    val maxDepth = depth
    val dialect = site.dialect
    def tiles(scene: Scene, media: SceneMedia | Null) =
      SplattedTiles(
        tracers(scene, maxDepth, regularizes, media, strategies),
        strategies = strategies
      )
    val apart = strategies.fold(""): s =>
      s", ${if s.isWeighted then "weighted" else "unweighted"} strategies apart"
    IntegratorPlan(
      (scene, _) => tiles(scene, null),
      samplesBsdf = false,
      s"$name, up to $maxDepth scattering events" +
        (if regularizes then ", regularised" else "") + apart,
      layers = strategies.fold(Vector.empty)(_.layers),
      followsSpecular = dialect == Dialect.V4,
      throughMedia = Option.when(dialect != Dialect.V2): (scene, media) =>
        limit(scene, media) match
          case None => tiles(scene, media)
          case Some(what) =>
            inVolpath(name, what, scene, media, maxDepth, regularizes, strategies)
      ,
      throughVolumes = Some: (scene, _, march) =>
        site.warn(
          Code.IntegratorLacks,
          s"\"$name\" does not support volumes yet; using \"path\", which ${lack(strategies)}"
        )
        val limits = PathLimits(maxDepth, RouletteDepth)
        RenderMethod.tiles(scene)(PathTracer(_, limits, volumes = march()))
    )

  /** What of a scene with media is not supported. */
  private def limit(scene: Scene, media: SceneMedia): Option[String] =
    // Such light would be traced from the border of the scene, through less of the medium
    if scene.lights.exists(_.isInfinite) && PathMedia.beyondAll(scene, media) >= 0 then
      Some("light from infinity in a medium without end")
    else if scene.isDispersive then Some("dispersion beside media")
    else if scene.hasSubsurface then Some("subsurface scattering beside media")
    else None

  private def inVolpath(
      name: String,
      what: String,
      scene: Scene,
      media: SceneMedia,
      depth: Int,
      regularizes: Boolean,
      strategies: Option[Strategies] = None
  )(using site: Site): RenderMethod =
    site.warn(
      Code.IntegratorLacks,
      s"\"$name\" does not support $what yet; using \"volpath\", which ${lack(strategies)}"
    )
    val limits = PathLimits(depth, RouletteDepth, seesThrough = site.dialect == Dialect.V3)
    val options = PathOptions(regularizes, subsurface = scene.hasSubsurface)
    RenderMethod.tiles(scene)(VolumePathTracer(_, media, limits, options))

  private def tracers(
      scene: Scene,
      depth: Int,
      regularizes: Boolean,
      media: SceneMedia | Null,
      strategies: Option[Strategies] = None
  )(using Site): View => WorkerIntegrators =
    v => WorkerIntegrators(scene)(tracer(_, v, depth, regularizes, media, strategies)(v.splats))

  private def tracer(
      scene: Scene,
      view: View,
      depth: Int,
      regularizes: Boolean,
      media: SceneMedia | Null,
      strategies: Option[Strategies] = None
  )(splats: Splats)(using site: Site): BidirectionalPathTracer =
    val compresses = site.dialect != Dialect.V2
    BidirectionalPathTracer(
      scene, view.camera, splats, depth, SubpathRouletteDepth, compresses, regularizes, media,
      strategies.orNull
    )

  /** Plan of [[MarkovChains]]. Volumes use the fallback above.
    *
    * @param mutations mutations per pixel
    */
  def metropolis(
      name: String,
      depth: Int,
      mutations: Int,
      settings: MetropolisSettings,
      regularizes: Boolean = false
  )(using site: Site): IntegratorPlan =
    val isV2 = site.dialect == Dialect.V2
    val maxDepth = depth
    val seeded = settings.copy(seed = site.resources.seed)
    def chains(scene: Scene, media: SceneMedia | Null) =
      Chains(
        (view, splats) => tracer(scene, view, maxDepth, regularizes, media)(splats),
        (view, paths) => MarkovChains(paths, seeded, view),
        tracers(scene, maxDepth, regularizes, media)
      )
    plan(name, depth, regularizes).copy(
      method = (scene, _) => chains(scene, null),
      throughMedia = Option.when(!isV2): (scene, media) =>
        limit(scene, media) match
          case None => chains(scene, media)
          case Some(what) => inVolpath(name, what, scene, media, maxDepth, regularizes)
      ,
      describe = s"$name, up to $maxDepth scattering events, ${settings.chains} chains",
      samples = Some(mutations)
    )

  private def lack(strategies: Option[Strategies]): String =
    "misses caustics from point lights" +
      strategies.fold("")(_ => " and has no strategies to tell apart")

/** Plans that use [[PhotonPasses]]. */
private[build] object PhotonPlans:
  /** Whose square is a number. */
  val Radius: Range = Range.atLeast(1e-15f)

  /** @param depth  maximum number of scattering events of a camera path
    * @param passes number of passes, if set by the scene
    */
  def plan(name: String, depth: Int, settings: PhotonSettings, passes: Option[Int])(
      using site: Site
  ): IntegratorPlan =
    val maxDepth = depth
    val seeded = settings.copy(seed = settings.seed ^ site.resources.seed)
    val interfaces =
      if site.dialect == Dialect.V4 then Interfaces.Weighed else IntegratorPlan.interfaces
    BidirectionalPlans
      .plan(name, maxDepth)
      .copy(
        method =
          (scene, _) => Passes(PhotonPasses(scene, maxDepth, seeded, _, interfaces)),
        describe =
          s"$name, up to $maxDepth scattering events, initial photon radius ${settings.radius}",
        samples = passes,
        interfaces = interfaces,
        throughMedia = None
      )
