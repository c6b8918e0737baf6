package candela.build.integrators

import candela.build.recipe.*
import candela.integrators.*
import candela.render.RenderMethod
import candela.scenefile.Dialect

final class PathRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends IntegratorRecipe(name, meaning, dialects)
    with Windowed
    with Choosing
    with Regularizing:
  private val threshold =
    float("rrthreshold", "throughput below which a path may end", onlyV3)(1f)

  protected def make()(using site: Site): IntegratorPlan =
    // v2 lights one vertex more than it counts
    val depth = Math.max(0, maxDepth()) + (if site.dialect == Dialect.V2 then 1 else 0)
    // v2's path and v4's take such a surface for glass, or see its reflection alone
    val goesBeneath = site.dialect == Dialect.V3 || name == "volpath"
    val widens = regularize()
    val limits = PathLimits(depth, threshold(), seesThrough = site.dialect == Dialect.V3)
    windowed(IntegratorPlan(
      (scene, _) =>
        val wavelengths = Dispersions.wavelengths(scene)
        val subsurface = goesBeneath && scene.hasSubsurface
        RenderMethod.Tiles(
          PathTracer(scene, limits, WalkOptions(widens, wavelengths, subsurface))
        )
      ,
      samplesBsdf = true,
      s"$name, up to $depth scattering events" + (if widens then ", regularized" else ""),
      followsSpecular = site.dialect == Dialect.V4,
      goesBeneath = goesBeneath,
      lights = lightStrategy(),
      throughMedia = Option.when(name == "volpath")((scene, media) =>
        VolumePathTracer(
          scene,
          media,
          limits,
          WalkOptions(widens, subsurface = scene.hasSubsurface)
        )
      ),
      throughVolumes = Some((scene, _, march) =>
        PathTracer(scene, limits, volumes = march)
      )
    ))

object SimplePathRecipe
    extends IntegratorRecipe("simplepath", "path tracing, without its refinements", onlyV4)
    with PathInstead:
  override def pending: Option[String] =
    Some(
      "the path integrator is used: the same light, and that of lamps that are points even where " +
        "`samplelights` is false"
    )
  declare(
    bool("samplelights", "are lights sampled?")(true),
    bool("samplebsdf", "are BSDFs sampled?")(true)
  )
  override protected def depth()(using Site): Int = maxDepth()

object SimpleVolPathRecipe
    extends IntegratorRecipe("simplevolpath", "path tracing through media, without lights", onlyV4)
    with PathInstead:
  override def pending: Option[String] =
    Some("\"volpath\" is used: the same light, and that of lamps that are points")
  override protected def seesMedia: Boolean = true
  override protected def depth()(using Site): Int = maxDepth()

object RandomWalkRecipe
    extends IntegratorRecipe("randomwalk", "path tracing into random directions", onlyV4)
    with PathInstead:
  override def pending: Option[String] =
    Some(
      "the path integrator is used: the same light, and that of lamps that are points, of " +
        "mirrors and of smooth glass"
    )
  override protected def depth()(using Site): Int = maxDepth()
