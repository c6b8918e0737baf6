package candela.build.integrators

import candela.bidirectional.*
import candela.build.recipe.*
import candela.film.{Splats, View}
import candela.integrators.{PathLimits, PathTracer, VolumePathTracer, WalkOptions}
import candela.integrators.LightTransport.RouletteAfter
import candela.render.RenderMethod
import candela.scene.Scene
import candela.scenefile.Dialect

/** Integrators whose paths start at lights, too. */
object BdptRecipe extends IntegratorRecipe("bdpt", "paths from camera and lights, joined", sinceV3)
    with Windowed
    with Regularizing:
  notYet("the picture alone is written")(
    bool("visualizestrategies", "write an image for each way to join")(false),
    bool("visualizeweights", "write their weights")(false)
  )
  noMeaning("all of them have the same mean; light paths start by power")(
    string("lightsamplestrategy", "how lights are chosen: uniform, power, spatial", onlyV3)(
      "power"
    )
  )
  protected def make()(using Site): IntegratorPlan =
    windowed(BidirectionalPlans.plan(name, maxDepth(), regularize()))

object MltRecipe
    extends IntegratorRecipe(
      "mlt",
      "Metropolis light transport: chains of paths from camera and lights",
      sinceV3
    )
    with Regularizing:
  private val bootstrap = integer(
    "bootstrapsamples",
    "least number of paths to start with; more until the brightness has a standard error of " +
      "0.3 %, or until they are half as many as all mutations"
  )(100000)
  private val chains = integer("chains", "Markov chains")(1000)
  private val mutations = integer("mutationsperpixel", "mutations of paths, for each pixel")(100)
  private val largeStep = float("largestepprobability", "of a path that is all new")(0.3f)
  private val sigma = float("sigma", "standard deviation of small mutations")(0.01f)

  protected def make()(using Site): IntegratorPlan =
    val settings = MetropolisSettings(bootstrap(), chains(), largeStep(), sigma())
    BidirectionalPlans.metropolis(name, maxDepth(), mutations(), settings, regularize())

object SppmRecipe extends IntegratorRecipe("sppm", "progressive photon mapping", sinceV3):
  private val passes = integer("numiterations", "passes", onlyV3)(64)
  private val passesToo = integer(
    "iterations",
    "another name of `numiterations`",
    onlyV3,
    shown = "numiterations"
  )(-1)
  private val photons =
    integer("photonsperiteration", "light paths of each pass", shown = "one a pixel")(-1)
  private val radius =
    float("radius", "in which photons are gathered at first", unit = "scene units")(1f)
  private val seed =
    integer("seed", "of the random numbers", onlyV4, shown = "the option's")(0)
  noMeaning("the image is written at the end")(
    integer("imagewritefrequency", "passes between images", onlyV3, shown = "never")(Int.MaxValue)
  )

  protected def make()(using site: Site): IntegratorPlan =
    val asked = if passesToo() > 0 then passesToo() else passes()
    // v4 takes as many as the sampler says
    val count = Option.when(site.dialect == Dialect.V3)(Math.max(1, asked))
    val settings =
      PhotonSettings(radius(), photons(), Math.max(0, maxDepth()), compresses = true, seed())
    PhotonPlans.plan(name, maxDepth(), settings, count)

object LightPathRecipe
    extends IntegratorRecipe("lightpath", "paths from the lights alone", onlyV4):
  override def pending: Option[String] =
    Some("\"bdpt\" is used: the same light, and that which is seen by way of mirrors or glass")
  protected def make()(using Site): IntegratorPlan = BidirectionalPlans.plan(name, maxDepth())

object FunctionRecipe
    extends Recipe[IntegratorPlan]("function", "no image: the error of samplers", onlyV4)
    with PathInstead:
  override def pending: Option[String] =
    Some("it makes no picture of the scene; the path integrator's is made")
  declare(
    oneOf(
      "function",
      "what is integrated",
      Vector("step", "diagonal", "disk", "checkerboard", "rotatedcheckerboard", "gaussian")
    )("step"),
    string("filename", "of the errors", shown = "function-mse.txt")(""),
    bool("skipbad", "leave out sample counts that the sampler does not like")(true),
    string("imagefilename", "of the function's picture", shown = "none")("")
  )

/** How [[BidirectionalPathTracer]] is made, for all that is rendered by it. */
private[build] object BidirectionalPlans:

  /** @param name by which the scene asked for it */
  def plan(name: String, depth: Int, widens: Boolean = false)(using site: Site): IntegratorPlan =
    val most = Math.max(0, depth)
    val dialect = site.dialect
    val shown = if name == "bdpt" then name else s"bdpt for $name"
    IntegratorPlan(
      (scene, _) => RenderMethod.SplattedTiles(v => tracer(scene, v, most, widens)(v.splats)),
      samplesBsdf = false,
      s"$shown, up to $most scattering events" + (if widens then ", regularized" else ""),
      followsSpecular = dialect == Dialect.V4,
      throughMedia = Option.when(dialect != Dialect.V2): (scene, media) =>
        site.warn(
          s"\"$name\" sees no media and no borders of media yet: \"volpath\" is used, $Lack"
        )
        VolumePathTracer(
          scene,
          media,
          PathLimits(most, seesThrough = dialect == Dialect.V3),
          WalkOptions(widens, subsurface = scene.hasSubsurface)
        )
      ,
      throughVolumes = Some: (scene, _, march) =>
        site.warn(s"\"$name\" sees no volumes yet: \"path\" is used, $Lack")
        PathTracer(scene, PathLimits(most), volumes = march)
    )

  private def tracer(scene: Scene, view: View, depth: Int, widens: Boolean)(splats: Splats)(
      using site: Site
  ): BidirectionalPathTracer =
    val compresses = site.dialect != Dialect.V2
    BidirectionalPathTracer(
      scene, view.camera, splats, depth, RouletteAfter, compresses, widens
    )

  /** Of [[MarkovChains]]: where there are media or volumes, as above.
    *
    * @param mutations for each pixel
    */
  def metropolis(
      name: String,
      depth: Int,
      mutations: Int,
      settings: MetropolisSettings,
      widens: Boolean = false
  )(using site: Site): IntegratorPlan =
    for
      (count, what) <- Seq(
        mutations -> "mutations",
        settings.bootstrap -> "bootstrap samples",
        settings.chains -> "chains"
      )
      if count < 1
    do site.error(s"there must be $what; found $count")
    if !(settings.largeStep >= 0f && settings.largeStep <= 1f) then
      site.error(s"`largestepprobability` must be in [0, 1]; found ${settings.largeStep}")
    val most = Math.max(0, depth)
    val seeded = settings.copy(seed = site.resources.seed)
    plan(name, depth, widens).copy(
      method = (scene, _) =>
        RenderMethod.Chains(
          v => MarkovChains(tracer(scene, v, most, widens), seeded, v),
          v => tracer(scene, v, most, widens)(v.splats)
        ),
      describe = s"$name, up to $most scattering events, ${settings.chains} chains",
      samples = Some(Math.max(1, mutations))
    )

  private val Lack =
    "the same light but for that of lamps that are points, by way of mirrors or glass"

/** How [[PhotonPasses]] are made. */
private[build] object PhotonPlans:

  /** @param depth  scattering events of a path from the camera
    * @param passes if the scene says how many
    */
  def plan(name: String, depth: Int, settings: PhotonSettings, passes: Option[Int])(
      using site: Site
  ): IntegratorPlan =
    val most = Math.max(0, depth)
    if !(settings.radius > 0f) then site.error("photons need a radius above 0")
    val seeded = settings.copy(seed = settings.seed ^ site.resources.seed)
    BidirectionalPlans
      .plan(name, most)
      .copy(
        method = (scene, _) => RenderMethod.Passes(PhotonPasses(scene, most, seeded, _)),
        describe =
          s"$name, up to $most scattering events, photons within ${settings.radius} at first",
        samples = passes,
        throughMedia = None
      )
