package candela.build.integrators

import candela.build.recipe.*
import candela.color.Rgb
import candela.integrators.{AmbientOcclusion, DirectLighting, Occlusion, Whitted}
import candela.math.*
import candela.render.RenderMethod
import candela.scenefile.Dialect

object DirectLightingRecipe
    extends IntegratorRecipe(
      "directlighting",
      "light that comes straight from lights, or by mirrors and glass",
      untilV3
    )
    with Windowed:
  private val strategy =
    // pbrt-v1 had "weighted", which the later ones read as "all"
    oneOf("strategy", "which lights are sampled", Vector("all", "one", "weighted"))("all")

  protected def make()(using Site): IntegratorPlan =
    val (depth, every) = (Math.max(1, maxDepth()), strategy() != "one")
    windowed(IntegratorPlan(
      (scene, samples) =>
        RenderMethod.Tiles(
          DirectLighting(scene, depth, if every then samples else Array.empty)
        ),
      // Only when each light has its turn can one of them be left to BSDF sampling
      samplesBsdf = every,
      s"directlighting, ${if every then "all lights" else "one light"} at each point",
      throughVolumes = Some((scene, samples, march) =>
        DirectLighting(scene, depth, if every then samples else Array.empty, march)
      )
    ))

object WhittedRecipe
    extends IntegratorRecipe("whitted", "mirrors, glass and hard shadows alone", untilV3)
    with Windowed:

  protected def make()(using Site): IntegratorPlan =
    val depth = Math.max(1, maxDepth())
    windowed(IntegratorPlan(
      (scene, _) => RenderMethod.Tiles(Whitted(scene, depth)),
      samplesBsdf = false,
      "whitted",
      throughVolumes = Some((scene, _, march) => Whitted(scene, depth, march))
    ))

/** In each dialect another picture: v2's value is the part of the rays that meet nothing, v3's
  * their mean by the cosine, times π, and v4's that mean, where nothing hides a point 1.
  */
object AmbientOcclusionRecipe
    extends Recipe[IntegratorPlan]("ambientocclusion", "how much of the sky each point sees")
    with Windowed:
  private val cosine = bool("cossample", "more rays along the normal?", sinceV3)(true)
  private val samples =
    integer("nsamples", "rays from each point", untilV3)(if v2 then 2048 else 64)
  private val distance =
    float("maxdist", "what is farther hides nothing", onlyV2, "scene units")(
      Float.PositiveInfinity
    )
  private val distanceV4 =
    float("maxdistance", "what is farther hides nothing", onlyV4, "scene units")(
      Float.PositiveInfinity
    )

  /** v2 passes over what is nearer, in scene units, so that surfaces do not hide themselves. */
  private val NearV2 = 0.01f

  protected def make()(using site: Site): IntegratorPlan =
    val white = site.resources.basis.fromSrgb(Rgb.White)
    val rule = site.dialect match
      case Dialect.V2 =>
        Occlusion(
          Math.max(1, samples()),
          NearV2,
          distance(),
          cosine = false,
          weighs = false,
          open = white,
          showsSky = true
        )
      case Dialect.V3 =>
        Occlusion(
          Math.max(1, samples()),
          0f,
          Float.PositiveInfinity,
          cosine(),
          weighs = true,
          white * Pi,
          showsSky = false
        )
      case Dialect.V4 =>
        Occlusion(1, 0f, distanceV4(), cosine(), weighs = true, white, showsSky = false)
    windowed(IntegratorPlan(
      (scene, _) => RenderMethod.Tiles(AmbientOcclusion(scene, rule)),
      samplesBsdf = true,
      s"ambientocclusion, ${rule.samples} rays from each point",
      isLit = false,
      throughVolumes = Some((scene, _, march) => AmbientOcclusion(scene, rule, march))
    ))
