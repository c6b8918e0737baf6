package candela.build

/** Recipes of v2's renderers, which are above its integrators. */
object Renderers:
  val all: Recipes[Unit] = Recipes(
    "renderer",
    Vector(
      SamplerRenderer("sampler"), SamplerRenderer("sample"), Metropolis, CreateProbes,
      SurfacePoints, AggregateTest
    )
  )

/** Of renderers that are not there yet. */
trait SamplerInstead extends Recipe[Unit]:
  override def pending: Option[String] = Some("the surface integrator is used")
  protected def make()(using Site): Unit = ()

/** The usual one; "sample" is what some scenes call it. */
final class SamplerRenderer(name: String)
    extends Recipe[Unit](name, "an image by the surface and volume integrators", onlyV2):
  notYet("the picture is drawn")(
    bool("visualizeobjectids", "show primitives by colours of their own")(false)
  )
  protected def make()(using Site): Unit = ()

object Metropolis
    extends Recipe[Unit]("metropolis", "Metropolis light transport", onlyV2)
    with SamplerInstead:
  declare(
    float("largestepprobability", "of a path that is all new")(0.25f),
    integer("samplesperpixel", "mutations, for each pixel")(100),
    integer("bootstrapsamples", "paths to start with")(100000),
    integer("directsamples", "samples of direct light in each pixel")(4),
    bool("dodirectseparately", "is direct light found without mutations?")(true),
    integer("maxconsecutiverejects", "after which any mutation is taken")(512),
    integer("maxdepth", "most bounces")(7),
    bool("bidirectional", "do paths start at lights, too?")(true)
  )

object CreateProbes
    extends Recipe[Unit]("createprobes", "no image: a file of light probes", onlyV2)
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

object SurfacePoints
    extends Recipe[Unit]("surfacepoints", "no image: a file of points on surfaces", onlyV2)
    with SamplerInstead:
  declare(
    float("minsampledistance", "between points", unit = "scene units")(0.25f),
    string("filename", "file of points", shown = "none")("")
  )

object AggregateTest
    extends Recipe[Unit]("aggregatetest", "no image: a test of accelerators", onlyV2)
    with SamplerInstead:
  declare(integer("niters", "rays to try")(100000))
