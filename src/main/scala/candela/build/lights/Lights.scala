package candela.build.lights

import candela.build.recipe.*

/** Recipes of lights that are no surfaces. */
object Lights:
  val all: Recipes[LightPlan] = Recipes(
    "light",
    Vector(
      PointLightRecipe,
      SpotLightRecipe,
      GoniometricLightRecipe,
      ProjectionLightRecipe,
      DistantLightRecipe,
      InfiniteLightRecipe("infinite", every),
      InfiniteLightRecipe("exinfinite", untilV3)
    )
  )
