package candela.build.integrators

import candela.aov.LightParts
import candela.build.recipe.*
import candela.guiding.Guide
import candela.integrators.*
import candela.render.{GuidedTiles, RenderMethod, Tiles}
import candela.scene.Scene
import candela.scenefile.Dialect

final class PathRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends IntegratorRecipe(name, meaning, dialects)
    with Windowed
    with Choosing
    with Regularizing:
  private val threshold =
    float("rrthreshold", "throughput below which Russian roulette may end a path", onlyV3)(1f)
  private val hides =
    bool("hideemitters", "hide area lights and sky from the camera", onlyMitsuba)(false)

  protected def create()(using site: Site): IntegratorPlan =
    // v2 samples lights at one vertex more than it counts
    val depth = maxDepth() + (if site.dialect == Dialect.V2 then 1 else 0)
    // "path" of v2 and v4 renders such a surface as glass, or as its reflection only
    val goesBeneath = site.rules.goesBeneath || name == "volpath"
    val regularizes = regularize()
    // Mitsuba's "path" counts what thin glass transmits as scattered, "volpath" does not
    val crossesPanes = name == "volpath" && site.rules.passes
    val interfaces = if name == "volpath" then Interfaces.Open else IntegratorPlan.interfaces
    val countsPassed = site.rules.passes && interfaces.stopsLight
    val limits = PathLimits(
      depth,
      LightTransport.RouletteDepth,
      threshold(),
      seesThrough = site.dialect == Dialect.V3
    )
    windowed(IntegratorPlan(
      (scene, _) =>
        val beneath = goesBeneath && scene.hasSubsurface
        val options = PathOptions(
          regularizes,
          beneath,
          hidesEmitters = hides(),
          interfaces = interfaces,
          countsPassed = countsPassed
        )
        CausticMethod(scene, limits, options, media = None):
          (workerScene, pathOptions, guide, parts) =>
            PathTracer(workerScene, limits, pathOptions, guide = guide, parts = parts)
      ,
      samplesBsdf = true,
      s"$name, up to $depth scattering events" + (if regularizes then ", regularised" else ""),
      followsSpecular = site.dialect == Dialect.V4,
      goesBeneath = goesBeneath,
      lights = lightStrategy(),
      crossesPanes = crossesPanes,
      interfaces = interfaces,
      hasVeils = countsPassed,
      looksForCaustics = true,
      throughMedia = Option.when(name == "volpath"): (scene, media) =>
        val options = PathOptions(
          regularizes,
          scene.hasSubsurface,
          crossesPanes = crossesPanes,
          hidesEmitters = hides()
        )
        CausticMethod(scene, limits, options, Some(media)):
          (workerScene, pathOptions, guide, parts) =>
            VolumePathTracer(workerScene, media, limits, pathOptions, guide, parts)
      ,
      throughVolumes = Some((scene, _, march) =>
        RenderMethod.tiles(scene)(PathTracer(_, limits, volumes = march()))
      )
    ))

/** Methods of integrators that can be guided. */
private object GuidedMethod:
  /** @param tracer that is guided, or not if there is no guide, and where it divides light */
  def apply(scene: Scene)(tracer: (Scene, Guide | Null, LightParts | Null) => Integrator)(
      using site: Site
  ): RenderMethod =
    val unguided = WorkerIntegrators(scene)(tracer(_, null, null))
    site.resources.settings.learning match
      case None => Tiles(unguided)
      case Some(settings) =>
        GuidedTiles(
          unguided,
          settings,
          guide =>
            WorkerIntegrators(scene): workerScene =>
              PartlyGuided(
                workerScene,
                guide,
                tracer(workerScene, guide, _),
                tracer(workerScene, null, _)
              )
        )

object SimplePathRecipe extends IntegratorRecipe("simplepath", "simple path tracing", onlyV4):
  private val samplesLights =
    bool("samplelights", "sample light sources; if not, point lights do not shine")(true)
  private val samplesBsdf =
    bool("samplebsdf", "sample BSDFs; if not, mirrors and smooth glass are black")(true)

  protected def create()(using Site): IntegratorPlan =
    val onward = if samplesBsdf() then Onward.Bsdf else Onward.Hemisphere
    SimplePlans.plan(name, maxDepth(), samplesLights(), onward)

object SimpleVolPathRecipe
    extends IntegratorRecipe(
      "simplevolpath",
      "simple path tracing in participating media, without light sampling: point lights do not " +
        "shine; surfaces may scatter light, too",
      onlyV4
    ):
  protected def create()(using Site): IntegratorPlan =
    val depth = maxDepth()
    val limits = PathLimits(depth, LightTransport.RouletteDepth)
    val options = PathOptions(samplesLights = false)
    SimplePlans
      .plan(name, depth, samplesLights = false, Onward.Bsdf)
      .copy(throughMedia =
        Some((scene, media) =>
          RenderMethod.tiles(scene)(VolumePathTracer(_, media, limits, options))
        )
      )

object RandomWalkRecipe
    extends IntegratorRecipe(
      "randomwalk",
      "path tracing in uniformly sampled directions: point lights do not shine; mirrors and " +
        "smooth glass are black",
      onlyV4
    ):
  protected def create()(using Site): IntegratorPlan =
    SimplePlans.plan(name, maxDepth(), samplesLights = false, Onward.Sphere, crosses = false)

/** Plans that use [[SimplePathTracer]]. */
private object SimplePlans:
  def plan(
      name: String,
      depth: Int,
      samplesLights: Boolean,
      onward: Onward,
      crosses: Boolean = true
  ): IntegratorPlan =
    val maxDepth = depth
    val suffix = if samplesLights then "" else ", without light sampling"
    IntegratorPlan(
      (scene, _) =>
        RenderMethod.tiles(scene)(SimplePathTracer(_, maxDepth, samplesLights, onward, crosses)),
      samplesBsdf = !samplesLights,
      s"$name, up to $maxDepth scattering events$suffix",
      samplesLights = samplesLights,
      interfaces = if samplesLights then Interfaces.Closed else Interfaces.Open
    )
