package candela.build.integrators

import candela.diagnostics.Code
import candela.aov.{ImageLayer, MediaTransmittance}
import candela.bsdf.Material
import candela.build.recipe.*
import candela.film.PixelBounds
import candela.integrators.*
import candela.lights.LightStrategy
import candela.math.Vec3
import candela.media.SceneMedia
import candela.render.RenderMethod
import candela.scene.Scene
import candela.scenefile.Dialect

/** Recipes of integrators; v2 calls them surface integrators. */
object Integrators:
  val all: Recipes[IntegratorPlan] = Recipes(
    "integrator",
    Vector(
      PathRecipe("path", "path tracing", every),
      PathRecipe("volpath", "path tracing with participating media", sinceV3),
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

/** An integrator and its render method, built once the scene is known.
  *
  * @param method       creates the render method from the scene and the number of samples of each
  *                     light
  * @param samplesBsdf  whether the integrator also finds lights by BSDF sampling; if so, lights may
  *                     rely on it for some directions
  * @param goesBeneath  whether the integrator supports subsurface scattering
  * @param window       rendered window of the full image; None: all of it
  * @param samples      samples per pixel, if set by the integrator instead of the sampler
  * @param lights       light sampling strategy
  * @param samplesLights whether the integrator finds lights that no ray hits
  * @param isLit        whether the integrator uses lights; if not, a scene without them is valid
  * @param followsSpecular whether textures are also filtered along specular paths
  * @param crossesPanes whether panes do not scatter what they transmit, for `throughMedia`
  * @param interfaces   what interfaces of media are to light sampling
  * @param hasVeils     whether the openings of masks are interfaces, too
  * @param looksForCaustics whether it does so if asked to
  * @param layers       that it brings to the image
  * @param finish       what the integrator makes of each material
  * @param throughMedia   render method for scenes with participating media, if supported
  * @param throughVolumes the same for scenes with v2's volumes, through which each worker marches
  */
final case class IntegratorPlan(
    method: (Scene, Array[Int]) => RenderMethod,
    samplesBsdf: Boolean,
    describe: String,
    followsSpecular: Boolean = true,
    goesBeneath: Boolean = false,
    lights: LightStrategy = LightStrategy.Importance,
    samplesLights: Boolean = true,
    isLit: Boolean = true,
    samples: Option[Int] = None,
    window: Option[PixelBounds] = None,
    crossesPanes: Boolean = false,
    interfaces: Interfaces = Interfaces.Open,
    hasVeils: Boolean = false,
    looksForCaustics: Boolean = false,
    layers: Vector[ImageLayer] = Vector.empty,
    finish: Material => Material = identity,
    throughMedia: Option[(Scene, SceneMedia) => RenderMethod] = None,
    throughVolumes: Option[(Scene, Array[Int], () => VolumeMarch) => RenderMethod] = None
):
  /** Whether [[throughMedia]] renders the scene.
    *
    * @param hasMedia whether rays may pass media
    */
  def entersMedia(scene: Scene, hasMedia: Boolean): Boolean =
    throughMedia.isDefined &&
      (hasMedia || scene.hasInterfaces || crossesPanes && scene.hasPanes)

  /** The render method of the scene in these surroundings. */
  def methodIn(around: Surroundings, scene: Scene, lightSamples: Array[Int]): RenderMethod =
    (around, throughMedia, throughVolumes) match
      case (Surroundings.Media(all), Some(make), _) => make(scene, all)
      case (Surroundings.Volumes(march), _, Some(make)) =>
        make(scene, lightSamples, () => march(scene))
      case _ => method(scene, lightSamples)

/** What is between the surfaces of a scene, as far as its integrator renders it. */
enum Surroundings:
  case Nothing
  case Media(all: SceneMedia)

  /** The volumes of pbrt-v2, and what marches through them for a worker. */
  case Volumes(march: Scene => VolumeMarch)

  /** Its estimate of what media leave of light, if there are any. */
  def transmittance(scene: Scene): Option[MediaTransmittance] = this match
    case Media(all) => Some(MediaTransmittance(scene, all))
    case _ => None

  /** The same around a camera elsewhere. */
  def seenFrom(eye: Vec3): Surroundings = this match
    case Media(all) => Media(all.seenFrom(eye))
    case _ => this

object IntegratorPlan:
  /** What interfaces are to integrators without media. pbrt-v2 has none. */
  def interfaces(using site: Site): Interfaces = site.dialect match
    case Dialect.V2 => Interfaces.Open
    case _ if site.rules.opens => Interfaces.Open
    case Dialect.V3 => Interfaces.Lossy
    case Dialect.V4 | Dialect.Mitsuba | Dialect.Gltf => Interfaces.Closed

/** More than any path has, and fewer than overflow. */
private[build] val PathDepths = Range(0f, 1e9f).limited

/** Base of integrators with a maximum path depth. */
abstract class IntegratorRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends Recipe[IntegratorPlan](name, meaning, dialects):
  protected val maxDepth: Field[Int] =
    integer("maxdepth", "maximum number of scattering events", range = PathDepths)(5)

/** Integrators whose v3 form limits the rendered pixels, in addition to the film. */
trait Windowed extends Recipe[IntegratorPlan]:
  private val window =
    integers("pixelbounds", "x0 x1 y0 y1: pixels to render", onlyV3, "integer[4]", "all")

  protected final def windowed(plan: IntegratorPlan)(using site: Site): IntegratorPlan =
    val bounds = window()
    if bounds.length == 0 then plan
    else if bounds.length == 4 then
      plan.copy(window = Some(PixelBounds(bounds(0), bounds(2), bounds(1), bounds(3))))
    else
      site.error(
        Code.ParameterValue,
        s"`pixelbounds` must be x0 x1 y0 y1, found ${bounds.length} numbers"
      )
      plan

/** Integrators that sample one light per vertex, by a selectable strategy. */
trait Choosing extends Recipe[IntegratorPlan]:
  private val sampler = oneOf(
    "lightsampler",
    "light sampling strategy (bvh and exhaustive: by importance)",
    Vector("bvh", "exhaustive", "power", "uniform"),
    onlyV4
  )("bvh")
  private val strategy = oneOf(
    "lightsamplestrategy",
    "light sampling strategy (spatial: by importance)",
    Vector("spatial", "power", "uniform"),
    onlyV3
  )("spatial")

  protected final def lightStrategy()(using site: Site): LightStrategy =
    val choice = site.dialect match
      case Dialect.V4 | Dialect.Mitsuba | Dialect.Gltf => sampler()
      case Dialect.V3 => strategy()
      case _ => ""
    choice match
      case "power" => LightStrategy.Power
      case "uniform" => LightStrategy.Uniform
      case _ => LightStrategy.Importance

/** Integrators whose v4 form can regularise BSDFs. */
trait Regularizing extends Recipe[IntegratorPlan]:
  protected final val regularize: Field[Boolean] = bool(
    "regularize",
    "roughen BSDFs to at least 0.1 after the first non-specular bounce",
    onlyV4
  )(false)

/** Recipes of unsupported integrators, which fall back to path tracing. */
trait PathInstead extends Recipe[IntegratorPlan]:
  protected def depth()(using Site): Int = 5

  protected def create()(using site: Site): IntegratorPlan =
    val depthLimit = depth()
    val limits = PathLimits(
      depthLimit,
      LightTransport.RouletteDepth,
      seesThrough = site.dialect == Dialect.V3
    )
    val interfaces = IntegratorPlan.interfaces
    val options = PathOptions(interfaces = interfaces)
    IntegratorPlan(
      (scene, _) => RenderMethod.tiles(scene)(PathTracer(_, limits, options)),
      samplesBsdf = true,
      s"path, up to $depthLimit scattering events",
      followsSpecular = site.dialect == Dialect.V4,
      interfaces = interfaces,
      throughVolumes =
        Some((scene, _, march) =>
          RenderMethod.tiles(scene)(PathTracer(_, limits, volumes = march()))
        )
    )
