package candela.build.integrators

import candela.build.recipe.*
import candela.integrators.{DirectLighting, Whitted}
import candela.render.RenderMethod

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
