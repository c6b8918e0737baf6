package candela.build.integrators

import candela.bidirectional.MetropolisSettings
import candela.build.recipe.*

/** Recipes of v2's renderers, which are above its integrators: what they use in place of the one
  * that the scene names, if anything.
  */
object Renderers:
  val all: Recipes[Option[IntegratorPlan]] = Recipes(
    "renderer",
    Vector(
      SamplerRendererRecipe("sampler"), SamplerRendererRecipe("sample"), MetropolisRecipe,
      CreateProbesRecipe, SurfacePointsRecipe, AggregateTestRecipe
    )
  )

/** Of renderers that are not there yet. */
trait SamplerInstead extends Recipe[Option[IntegratorPlan]]:
  override def pending: Option[String] =
    Some("the picture is made that the surface integrator makes")
  protected def make()(using Site): Option[IntegratorPlan] = None

/** The usual one; "sample" is what some scenes call it. */
final class SamplerRendererRecipe(name: String)
    extends Recipe[Option[IntegratorPlan]](
      name,
      "an image by the surface and volume integrators",
      onlyV2
    ):
  notYet("the picture is drawn")(
    bool("visualizeobjectids", "show primitives by colours of their own")(false)
  )
  protected def make()(using Site): Option[IntegratorPlan] = None

/** It names no surface integrator: its chains walk among paths that are joined to light paths. */
object MetropolisRecipe
    extends Recipe[Option[IntegratorPlan]](
      "metropolis",
      "Metropolis light transport: chains of paths from camera and lights",
      onlyV2
    ):
  private val depth = integer("maxdepth", "most bounces")(7)
  private val largeStep = float("largestepprobability", "of a path that is all new")(0.25f)
  private val mutations = integer("samplesperpixel", "mutations, for each pixel")(100)
  private val bootstrap = integer(
    "bootstrapsamples",
    "least number of paths to start with; more until the brightness has a standard error of " +
      "0.3 %, or until they are half as many as all mutations"
  )(100000)
  noMeaning("the chains find all light, by paths from both ends: the same mean")(
    integer("directsamples", "samples of direct light in each pixel")(4),
    bool("dodirectseparately", "is direct light found without mutations?")(true),
    bool("bidirectional", "do paths start at lights, too?")(true)
  )
  noMeaning("no mutation is taken against the rule: that would make the image wrong")(
    integer("maxconsecutiverejects", "after which any mutation is taken")(512)
  )

  protected def make()(using Site): Option[IntegratorPlan] =
    val settings = MetropolisSettings(bootstrap(), Chains, largeStep(), Sigma)
    Some(BidirectionalPlans.metropolis(name, depth(), mutations(), settings))

  // As v3's "mlt", where v2 goes by its threads and by another distribution
  private val Chains = 1000
  private val Sigma = 0.01f

object CreateProbesRecipe
    extends Recipe[Option[IntegratorPlan]](
      "createprobes",
      "no image: a file of light probes",
      onlyV2
    )
    with SamplerInstead:
  declare(
    bool("directlighting", "with direct light?")(true),
    bool("indirectlighting", "with indirect light?")(true),
    integer("lmax", "degree of the spherical harmonics")(4),
    integer("indirectsamples", "rays from each probe")(512),
    numbers("bounds", "float[6]", "box of the probes", unit = "scene units", shown = "the scene's"),
    float("samplespacing", "between probes", unit = "scene units")(1f),
    float("time", "at which light is found", unit = "s")(0f),
    string("filename", "file of probes")("probes.out")
  )

object SurfacePointsRecipe
    extends Recipe[Option[IntegratorPlan]](
      "surfacepoints",
      "no image: a file of points on surfaces",
      onlyV2
    )
    with SamplerInstead:
  declare(
    float("minsampledistance", "between points", unit = "scene units")(0.25f),
    string("filename", "file of points", shown = "none")("")
  )

object AggregateTestRecipe
    extends Recipe[Option[IntegratorPlan]](
      "aggregatetest",
      "no image: a test of accelerators",
      onlyV2
    )
    with SamplerInstead:
  declare(integer("niters", "rays to try")(100000))

/** How volumes are rendered.
  *
  * @param stepSize in scene units
  * @param scatters is light that comes from lights scattered by them?
  */
final case class VolumeMethod(stepSize: Float, scatters: Boolean):
  def describe: String =
    (if scatters then "emission and single scattering" else "emission") + s" in steps of $stepSize"

object VolumeMethod:
  /** Where v2 says nothing. */
  val Default: VolumeMethod = VolumeMethod(1f, scatters = false)

/** Recipes of v2's volume integrators. They matter to volumes alone. */
object VolumeIntegrators:
  val all: Recipes[VolumeMethod] = Recipes(
    "volume integrator",
    Vector(
      VolumeIntegratorRecipe("emission", "what volumes emit and absorb", scatters = false),
      VolumeIntegratorRecipe(
        "single",
        "the same, and light that is scattered once",
        scatters = true
      )
    )
  )

final class VolumeIntegratorRecipe(name: String, meaning: String, scatters: Boolean)
    extends Recipe[VolumeMethod](name, meaning, onlyV2):
  private val stepSize = float("stepsize", "of a walk through a volume", unit = "scene units")(1f)

  protected def make()(using site: Site): VolumeMethod =
    val size = stepSize()
    if size > 0f then VolumeMethod(size, scatters)
    else
      site.error(s"`stepsize` must be above 0, not $size")
      VolumeMethod(1f, scatters)
