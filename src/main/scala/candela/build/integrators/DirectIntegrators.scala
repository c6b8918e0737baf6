package candela.build

import candela.integrators.{DirectLighting, Whitted}

object Direct
    extends IntegratorRecipe(
      "directlighting",
      "light that comes straight from lights, or by mirrors and glass",
      untilV3
    ):
  private val strategy =
    // pbrt-v1 had "weighted", which the later ones read as "all"
    oneOf("strategy", "which lights are sampled", Vector("all", "one", "weighted"))("all")
  windowed()

  protected def make()(using Site): IntegratorPlan =
    val (depth, every) = (Math.max(1, maxDepth()), strategy() != "one")
    IntegratorPlan(
      (scene, samples) => DirectLighting(scene, depth, if every then samples else Array.empty),
      // Only when each light has its turn can one of them be left to BSDF sampling
      samplesBsdf = every,
      s"directlighting, ${if every then "all lights" else "one light"} at each point",
      throughVolumes = Some((scene, samples, march) =>
        DirectLighting(scene, depth, if every then samples else Array.empty, march)
      )
    )

object WhittedRecipe
    extends IntegratorRecipe("whitted", "mirrors, glass and hard shadows alone", untilV3):
  windowed()

  protected def make()(using Site): IntegratorPlan =
    val depth = Math.max(1, maxDepth())
    IntegratorPlan(
      (scene, _) => Whitted(scene, depth),
      samplesBsdf = false,
      "whitted",
      throughVolumes = Some((scene, _, march) => Whitted(scene, depth, march))
    )

object AmbientOcclusion
    extends Recipe[IntegratorPlan]("ambientocclusion", "how much of the sky each point sees")
    with PathInstead:
  override def pending: Option[String] =
    Some("the path integrator is used, whose picture is another: lamps and materials count")

  declare(
    bool("cossample", "more rays along the normal?", sinceV3)(true),
    integer("nsamples", "rays from each point", untilV3)(if v2 then 2048 else 64),
    float("maxdist", "what is farther hides nothing", onlyV2, "scene units")(
      Float.PositiveInfinity
    ),
    float("maxdistance", "what is farther hides nothing", onlyV4, "scene units")(
      Float.PositiveInfinity
    ),
    integers("pixelbounds", "x0 x1 y0 y1: the part to render", onlyV3, "integer[4]", "all")
  )
