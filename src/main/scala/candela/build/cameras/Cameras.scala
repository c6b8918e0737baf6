package candela.build.cameras

import candela.build.recipe.*

/** Recipes of cameras. */
object Cameras:
  val all: Recipes[CameraPlan] =
    Recipes(
      "camera",
      Vector(
        PerspectiveRecipe, OrthographicRecipe, EnvironmentRecipe, SphericalRecipe, RealisticRecipe,
        ForkedRealisticRecipe
      )
    )
