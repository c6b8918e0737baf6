package candela.build.lights

import candela.build.recipe.*

/** Recipes of lights that are no surfaces. */
object Lights:
  val all: Recipes[LightPlan] = Recipes(
    "light",
    Vector(
      PointLights,
      SpotLights,
      GoniometricLights,
      ProjectionLights,
      DistantLights,
      InfiniteLights("infinite", every),
      InfiniteLights("exinfinite", untilV3)
    )
  )
