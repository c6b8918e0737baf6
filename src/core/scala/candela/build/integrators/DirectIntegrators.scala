package candela.build.integrators

import candela.build.recipe.*
import candela.color.Rgb
import candela.integrators.{AmbientOcclusion, Beyond, DirectLighting, Occlusion, Whitted}
import candela.math.*
import candela.render.RenderMethod
import candela.scene.Scene
import candela.scenefile.Dialect

object DirectLightingRecipe
    extends IntegratorRecipe(
      "directlighting",
      "direct lighting and specular paths",
      untilV3
    )
    with Windowed:
  private val strategy =
    // pbrt-v1's "weighted", which v2 and v3 read as "all"
    oneOf("strategy", "lights sampled at each point", Vector("all", "one", "weighted"))("all")

  protected def create()(using Site): IntegratorPlan =
    val (depth, every) = (Math.max(1, maxDepth()), strategy() != "one")
    val interfaces = IntegratorPlan.interfaces
    windowed(IntegratorPlan(
      (scene, samples) =>
        val sampleCounts = if every then samples else Array.empty[Int]
        RenderMethod.tiles(scene)(DirectLighting(_, depth, sampleCounts, interfaces = interfaces))
      ,
      // Lights can rely on BSDF sampling only if every light is sampled
      samplesBsdf = every,
      s"directlighting, ${if every then "all lights" else "one light"} at each point",
      interfaces = interfaces,
      throughVolumes = Some((scene, samples, march) =>
        val sampleCounts = if every then samples else Array.empty[Int]
        RenderMethod.tiles(scene)(DirectLighting(_, depth, sampleCounts, march()))
      )
    ))

object WhittedRecipe
    extends IntegratorRecipe(
      "whitted",
      "specular paths and direct light, without BSDF sampling",
      untilV3
    )
    with Windowed:

  protected def create()(using Site): IntegratorPlan =
    val depth = Math.max(1, maxDepth())
    val interfaces = IntegratorPlan.interfaces
    windowed(IntegratorPlan(
      (scene, _) => RenderMethod.tiles(scene)(Whitted(_, depth, interfaces = interfaces)),
      samplesBsdf = false,
      "whitted",
      interfaces = interfaces,
      throughVolumes =
        Some((scene, _, march) => RenderMethod.tiles(scene)(Whitted(_, depth, march())))
    ))

/** Differs between dialects: v2 computes the unoccluded fraction of the rays, v3 their
  * cosine-weighted mean times π, v4 that mean, which is 1 at an unoccluded point, Mitsuba the same,
  * which is 1 beyond all surfaces, too.
  */
object AmbientOcclusionRecipe
    extends Recipe[IntegratorPlan]("ambientocclusion", "unoccluded part of the hemisphere")
    with Windowed:
  private val cosine = bool("cossample", "sample directions by the cosine", sinceV3)(true)
  private val samples =
    integer("nsamples", "rays per point", untilV3, range = Range.atLeast(1f).limited)(if v2 then
      2048
    else 64)
  private val distance =
    float(
      "maxdist", "maximum distance of occluders", onlyV2, "scene units", range = Range.endless
    )(
      Float.PositiveInfinity
    )
  private val distanceV4 =
    float(
      "maxdistance",
      "maximum distance of occluders",
      onlyV4,
      "scene units",
      range = Range.Unlimited
    )(
      Float.PositiveInfinity
    )

  /** Minimum distance of v2's occluders in scene units, which avoids self-occlusion. */
  private val NearV2 = 0.01f

  protected def create()(using site: Site): IntegratorPlan =
    val white = site.resources.basis.ofLight(Rgb.White)
    val rule = site.dialect match
      case Dialect.V2 =>
        Occlusion(
          samples(),
          NearV2,
          distance(),
          cosine = false,
          weighs = false,
          open = white,
          Beyond.Sky
        )
      case Dialect.V3 =>
        Occlusion(
          samples(),
          0f,
          Float.PositiveInfinity,
          cosine(),
          weighs = true,
          white * Pi,
          Beyond.Black
        )
      case Dialect.V4 | Dialect.Mitsuba | Dialect.Gltf =>
        val beyond = if site.rules.dialect == Dialect.Mitsuba then Beyond.Open else Beyond.Black
        Occlusion(1, 0f, distanceV4(), cosine(), weighs = true, white, beyond)
    // Below 0, Mitsuba 0.6 takes a quarter of the scene's diameter; in pbrt, nothing occludes
    val isRelative = rule.end < 0f && site.rules.dialect == Dialect.Mitsuba
    def ruleFor(scene: Scene) =
      if isRelative then rule.copy(end = scene.ball.radius / 2) else rule
    windowed(IntegratorPlan(
      (scene, _) => RenderMethod.tiles(scene)(AmbientOcclusion(_, ruleFor(scene))),
      samplesBsdf = true,
      s"ambientocclusion, ${rule.samples} rays per point",
      isLit = false,
      throughVolumes =
        Some((scene, _, march) =>
          RenderMethod.tiles(scene)(AmbientOcclusion(_, ruleFor(scene), march()))
        )
    ))
