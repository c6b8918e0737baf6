package candela.build

/** Recipes of lights that are no surfaces. */
object Lights:
  val all: Recipes[LightPlan] = Recipes(
    "light",
    Vector(PointLights, DistantLights, InfiniteLights),
    Vector("spot", "goniometric", "projection").map(_ -> "it is left out").toMap
  )
