package candela.build.integrators

import candela.build.recipe.*

/** Recipes of integrators; v2 calls them surface integrators. */
object Integrators:
  val all: Recipes[IntegratorPlan] = Recipes(
    "integrator",
    Vector(
      Path("path", "path tracing", every),
      Path("volpath", "path tracing, through media", sinceV3),
      Direct,
      WhittedRecipe,
      AmbientOcclusionRecipe,
      Bdpt,
      Mlt,
      Sppm,
      SimplePath,
      SimpleVolPath,
      RandomWalk,
      LightPath,
      FunctionIntegrator,
      PhotonMap("photonmap"),
      PhotonMap("exphotonmap"),
      IrradianceCache,
      InstantGlobalIllumination,
      DipoleSubsurface,
      DiffusePrt,
      GlossyPrt,
      UseProbes
    )
  )
