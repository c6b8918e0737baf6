package candela.build.cameras

import candela.build.recipe.*

/** Recipes of cameras. */
object Cameras:
  val all: Recipes[CameraPlan] =
    Recipes(
      "camera",
      Vector(Perspective, Orthographic, Environment, Spherical, Realistic, RealisticOfForks)
    )
