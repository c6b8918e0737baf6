package candela.build.integrators

import candela.build.recipe.*
import candela.film.PixelBounds
import candela.integrators.*
import candela.lights.LightStrategy
import candela.media.SceneMedia
import candela.render.RenderMethod
import candela.sampling.Wavelengths
import candela.scene.Scene
import candela.scenefile.{Dialect, SceneDescription}

/** Recipes of integrators; v2 calls them surface integrators. */
object Integrators:
  val all: Recipes[IntegratorPlan] = Recipes(
    "integrator",
    Vector(
      PathRecipe("path", "path tracing", every),
      PathRecipe("volpath", "path tracing, through media", sinceV3),
      DirectLightingRecipe,
      WhittedRecipe,
      AmbientOcclusionRecipe,
      BdptRecipe,
      MltRecipe,
      SppmRecipe,
      SimplePathRecipe,
      SimpleVolPathRecipe,
      RandomWalkRecipe,
      LightPathRecipe,
      FunctionRecipe,
      PhotonMapRecipe("photonmap"),
      PhotonMapRecipe("exphotonmap"),
      IrradianceCacheRecipe,
      InstantGlobalIlluminationRecipe,
      DipoleSubsurfaceRecipe,
      DiffusePrtRecipe,
      GlossyPrtRecipe,
      UseProbesRecipe
    )
  )

/** An integrator and its method, to be made once the scene is known.
  *
  * @param method       how samples are organised, and by what they are taken; made of the scene and
  *                     how often each light is to be sampled
  * @param samplesBsdf  does it find lights by BSDF sampling too? Then lights may leave some to that
  * @param goesBeneath  does light travel beneath surfaces?
  * @param window       of the full image that is rendered, if not all of it is
  * @param samples      of each pixel, if the integrator and not the sampler says how many
  * @param lights       how the light to sample is chosen
  * @param isLit        do lights matter? Else a scene without them is no mistake
  * @param followsSpecular are textures filtered in mirrors and behind glass, too?
  * @param throughMedia   makes the integrator of tiles where there are media, if it sees them
  * @param throughVolumes likewise for v2's volumes
  */
final case class IntegratorPlan(
    method: (Scene, Array[Int]) => RenderMethod,
    samplesBsdf: Boolean,
    describe: String,
    followsSpecular: Boolean = true,
    goesBeneath: Boolean = false,
    lights: LightStrategy = LightStrategy.Importance,
    isLit: Boolean = true,
    samples: Option[Int] = None,
    window: Option[PixelBounds] = None,
    throughMedia: Option[(Scene, SceneMedia) => Integrator] = None,
    throughVolumes: Option[(Scene, Array[Int], VolumeMarch) => Integrator] = None
)

/** What many integrators have: how far light is followed. */
abstract class IntegratorRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends Recipe[IntegratorPlan](name, meaning, dialects):
  protected val maxDepth: Field[Int] =
    integer("maxdepth", "most scattering events of a path")(5)

/** v3's integrators can be told what to render, beside the film. */
trait Windowed extends Recipe[IntegratorPlan]:
  private val window =
    integers("pixelbounds", "x0 x1 y0 y1: the image's part to render", onlyV3, "integer[4]", "all")

  protected final def windowed(plan: IntegratorPlan)(using site: Site): IntegratorPlan =
    val asked = window()
    if asked.length == 0 then plan
    else if asked.length == 4 then
      plan.copy(window = Some(PixelBounds(asked(0), asked(2), asked(1), asked(3))))
    else
      site.error("`pixelbounds` takes x0 x1 y0 y1")
      plan

/** Those that choose one light of all at each point can be told how. */
trait Choosing extends Recipe[IntegratorPlan]:
  private val sampler = oneOf(
    "lightsampler",
    "how lights are chosen (bvh and exhaustive: by a tree of importance)",
    Vector("bvh", "exhaustive", "power", "uniform"),
    onlyV4
  )("bvh")
  private val strategy = oneOf(
    "lightsamplestrategy",
    "how lights are chosen (spatial: by a tree of importance)",
    Vector("spatial", "power", "uniform"),
    onlyV3
  )("spatial")

  protected final def lightStrategy()(using site: Site): LightStrategy =
    val asked = site.dialect match
      case Dialect.V4 => sampler()
      case Dialect.V3 => strategy()
      case _ => ""
    asked match
      case "power" => LightStrategy.Power
      case "uniform" => LightStrategy.Uniform
      case _ => LightStrategy.Importance

/** v4's can roughen what a path meets late. */
trait Regularizing extends Recipe[IntegratorPlan]:
  protected final val regularize: Field[Boolean] = bool(
    "regularize",
    "is what a path meets after it was spread roughened to 0.1 at least?",
    onlyV4
  )(false)

/** Of integrators that are not there yet. */
trait PathInstead extends Recipe[IntegratorPlan]:
  protected def depth()(using Site): Int = 5

  /** Does it see media in v3 and v4? */
  protected def seesMedia: Boolean = false

  protected def make()(using site: Site): IntegratorPlan =
    val most = Math.max(0, depth())
    val limits =
      PathLimits(most, rouletteAfter = 1, seesThrough = site.dialect == Dialect.V3)
    IntegratorPlan(
      (scene, _) =>
        val wavelengths = Dispersions.wavelengths(scene)
        RenderMethod.Tiles(PathTracer(scene, limits, WalkOptions(wavelengths = wavelengths)))
      ,
      samplesBsdf = true,
      s"path, up to $most scattering events",
      followsSpecular = site.dialect == Dialect.V4,
      throughMedia =
        Option.when(seesMedia)((scene, media) =>
          VolumePathTracer(scene, media, limits, WalkOptions(subsurface = scene.hasSubsurface))
        ),
      throughVolumes =
        Some((scene, _, march) => PathTracer(scene, limits, volumes = march))
    )

/** What is made of glass that splits light into its colours. */
private[build] object Dispersions:

  /** For paths, if the scene has such glass. */
  def wavelengths(scene: Scene)(using site: Site): Option[Wavelengths] =
    Option.when(scene.isDispersive)(Wavelengths(site.resources.basis))

  /** In words; with a warning if the integrator can't. */
  def describe(
      scene: Scene,
      method: RenderMethod,
      description: SceneDescription,
      problems: Findings
  ): String =
    if !scene.isDispersive then "none"
    else if method.splitsLight then "paths take one wavelength where light is split"
    else
      for d <- description.integrator.orElse(description.camera) do
        problems.warn(
          d.at,
          "glass that splits light is not supported here yet: its index at 589 nm is used"
        )
      "left out: one index for all wavelengths"
