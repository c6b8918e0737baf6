package candela.build.integrators

import candela.build.recipe.*

/** Recipes of integrators; v2 calls them surface integrators. */
object Integrators:
  val all: Recipes[IntegratorPlan] = Recipes(
    "integrator",
    Vector(
      PathRecipe("path", "path tracing", every),
      PathRecipe("volpath", "path tracing, through media", sinceV3),
      DirectLightingRecipe,
      WhittedRecipe,
      AmbientOcclusionRecipe,
      BdptRecipe,
      MltRecipe,
      SppmRecipe,
      SimplePathRecipe,
      SimpleVolPathRecipe,
      RandomWalkRecipe,
      LightPathRecipe,
      FunctionRecipe,
      PhotonMapRecipe("photonmap"),
      PhotonMapRecipe("exphotonmap"),
      IrradianceCacheRecipe,
      InstantGlobalIlluminationRecipe,
      DipoleSubsurfaceRecipe,
      DiffusePrtRecipe,
      GlossyPrtRecipe,
      UseProbesRecipe
    )
  )
