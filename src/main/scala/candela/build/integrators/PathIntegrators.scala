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
    float("rrthreshold", "throughput below which Russian roulette may end a path", onlyV3)(1f)

  protected def make()(using site: Site): IntegratorPlan =
    // v2 samples lights at one vertex more than it counts
    val depth = Math.max(0, maxDepth()) + (if site.dialect == Dialect.V2 then 1 else 0)
    // "path" of v2 and v4 renders such a surface as glass, or as its reflection only
    val goesBeneath = site.dialect == Dialect.V3 || name == "volpath"
    val regularizes = regularize()
    val limits = PathLimits(depth, threshold(), seesThrough = site.dialect == Dialect.V3)
    windowed(IntegratorPlan(
      (scene, _) =>
        val subsurface = goesBeneath && scene.hasSubsurface
        RenderMethod.Tiles(
          PathTracer(scene, limits, WalkOptions(regularizes, subsurface))
        )
      ,
      samplesBsdf = true,
      s"$name, up to $depth scattering events" + (if regularizes then ", regularised" else ""),
      followsSpecular = site.dialect == Dialect.V4,
      goesBeneath = goesBeneath,
      lights = lightStrategy(),
      throughMedia = Option.when(name == "volpath")((scene, media) =>
        VolumePathTracer(
          scene,
          media,
          limits,
          WalkOptions(regularizes, subsurface = scene.hasSubsurface)
        )
      ),
      throughVolumes = Some((scene, _, march) =>
        PathTracer(scene, limits, volumes = march)
      )
    ))

object SimplePathRecipe
    extends IntegratorRecipe("simplepath", "simple path tracing", onlyV4)
    with PathInstead:
  override def pending: Option[String] =
    Some(
      "using \"path\", which samples point lights even if `samplelights` is false"
    )
  declare(
    bool("samplelights", "sample light sources")(true),
    bool("samplebsdf", "sample BSDFs")(true)
  )
  override protected def depth()(using Site): Int = maxDepth()

object SimpleVolPathRecipe
    extends IntegratorRecipe(
      "simplevolpath",
      "simple path tracing in participating media, without light sampling",
      onlyV4
    )
    with PathInstead:
  override def pending: Option[String] =
    Some("using \"volpath\", which also renders point lights")
  override protected def seesMedia: Boolean = true
  override protected def depth()(using Site): Int = maxDepth()

object RandomWalkRecipe
    extends IntegratorRecipe("randomwalk", "path tracing in uniformly sampled directions", onlyV4)
    with PathInstead:
  override def pending: Option[String] =
    Some(
      "using \"path\", which also renders point lights, mirrors and smooth glass"
    )
  override protected def depth()(using Site): Int = maxDepth()
