package candela.build.integrators

import candela.mlt.MetropolisSettings
import candela.build.recipe.*

/** Recipes of v2's renderers. A renderer may override the surface integrator of the scene.
  */
object Renderers:
  val all: Recipes[Option[IntegratorPlan]] = Recipes(
    "renderer",
    Vector(
      SamplerRendererRecipe("sampler"), SamplerRendererRecipe("sample"), MetropolisRecipe,
      CreateProbesRecipe, SurfacePointsRecipe, AggregateTestRecipe
    )
  )

/** Recipes of unsupported renderers, which fall back to the surface integrator. */
trait SamplerInstead extends Recipe[Option[IntegratorPlan]]:
  override def substitute: Option[String] =
    Some("using \"sampler\", which renders the scene by its surface integrator")
  protected def create()(using Site): Option[IntegratorPlan] = None

/** The default renderer; some scenes call it "sample". */
final class SamplerRendererRecipe(name: String)
    extends Recipe[Option[IntegratorPlan]](
      name,
      "rendering by the surface and volume integrators",
      onlyV2
    ):
  unsupported("a debugging aid; the image is rendered")(
    bool("visualizeobjectids", "colour primitives by their id")(false)
  )
  protected def create()(using Site): Option[IntegratorPlan] = None

/** Metropolis renderer: replaces the surface integrator by chains of bidirectional paths. */
object MetropolisRecipe
    extends Recipe[Option[IntegratorPlan]](
      "metropolis",
      "Metropolis light transport with bidirectional paths",
      onlyV2
    ):
  private val depth = integer("maxdepth", "maximum bounces", range = PathDepths)(7)
  private val largeStep = float(
    "largestepprobability",
    "probability of an independent path",
    range = Range(0f, 1f)
  )(0.25f)
  private val mutations = integer(
    "samplesperpixel",
    "path mutations per pixel",
    range = MetropolisRanges.Counts
  )(100)
  private val bootstrap = integer(
    "bootstrapsamples",
    "minimum number of bootstrap paths; more are traced until the brightness has a standard " +
      "error of 0.3 %, or until there are as many as mutations",
    range = MetropolisRanges.Counts
  )(100000)
  noMeaning("the chains sample all light with bidirectional paths, with the same mean")(
    integer("directsamples", "direct light samples per pixel")(4),
    bool("dodirectseparately", "sample direct light without mutations")(true),
    bool("bidirectional", "also trace light subpaths")(true)
  )
  noMeaning("forced acceptance would bias the image")(
    integer("maxconsecutiverejects", "consecutive rejections before forced acceptance")(512)
  )

  protected def create()(using Site): Option[IntegratorPlan] =
    val settings = MetropolisSettings(bootstrap(), Chains, largeStep(), Sigma)
    Some(BidirectionalPlans.metropolis(name, depth(), mutations(), settings))

  // As v3's "mlt"; v2 derives these from its threads and another distribution
  private val Chains = 1000
  private val Sigma = 0.01f

object CreateProbesRecipe
    extends Recipe[Option[IntegratorPlan]](
      "createprobes",
      "light probe file; renders no image",
      onlyV2
    )
    with SamplerInstead:
  declare(
    bool("directlighting", "include direct light")(true),
    bool("indirectlighting", "include indirect light")(true),
    integer("lmax", "degree of the spherical harmonics")(4),
    integer("indirectsamples", "rays per probe")(512),
    numbers("bounds", "float[6]", "bounding box of the probes", unit = "scene units",
      shown = "the scene's"),
    float("samplespacing", "distance between probes", unit = "scene units")(1f),
    float("time", "time of the incident light", unit = "s")(0f),
    string("filename", "probe file")("probes.out")
  )

object SurfacePointsRecipe
    extends Recipe[Option[IntegratorPlan]](
      "surfacepoints",
      "surface point file; renders no image",
      onlyV2
    )
    with SamplerInstead:
  declare(
    float("minsampledistance", "minimum distance between points", unit = "scene units")(0.25f),
    string("filename", "file of surface points", shown = "none")("")
  )

object AggregateTestRecipe
    extends Recipe[Option[IntegratorPlan]](
      "aggregatetest",
      "accelerator test; renders no image",
      onlyV2
    )
    with SamplerInstead:
  declare(integer("niters", "number of test rays")(100000))

/** How v2's volumes are rendered.
  *
  * @param stepSize step of ray marching, in scene units
  * @param scatters whether single scattering of the lights is included
  */
final case class VolumeMethod(stepSize: Float, scatters: Boolean):
  def describe: String =
    (if scatters then "emission and single scattering" else "emission") + s" in steps of $stepSize"

object VolumeMethod:
  /** v2's default. */
  val Default: VolumeMethod = VolumeMethod(1f, scatters = false)

/** Recipes of v2's volume integrators, which affect volumes only. */
object VolumeIntegrators:
  val all: Recipes[VolumeMethod] = Recipes(
    "volume integrator",
    Vector(
      VolumeIntegratorRecipe("emission", "emission and absorption of volumes", scatters = false),
      VolumeIntegratorRecipe(
        "single",
        "emission, absorption and single scattering of volumes",
        scatters = true
      )
    )
  )

final class VolumeIntegratorRecipe(name: String, meaning: String, scatters: Boolean)
    extends Recipe[VolumeMethod](name, meaning, onlyV2):
  private val stepSize = float(
    "stepsize",
    "step of ray marching",
    unit = "scene units",
    range = Range.above(0f)
  )(1f)

  protected def create()(using Site): VolumeMethod =
    VolumeMethod(stepSize(), scatters)
