package candela.build.cameras

import candela.build.recipe.*
import candela.cameras.{OrthographicCamera, PerspectiveCamera}

object PerspectiveRecipe extends ProjectiveRecipe("perspective", "things far away look smaller"):
  private val fov = float("fov", "angle of the shorter side of the view", unit = "degrees")(90f)
  private val half =
    float("halffov", "half of `fov`, instead of it", untilV3, "degrees", "none")(-1f)

  protected def make()(using site: Site): CameraPlan =
    val angle = if half() > 0f then 2f * half() else fov()
    val isAngle = angle > 0f && angle < 180f
    if !isAngle then site.error(s"`fov` lies between 0 and 180 degrees; found $angle")
    CameraPlan(
      (toWorld, frame) => PerspectiveCamera(setup(toWorld, frame), if isAngle then angle else 90f),
      shutter()
    )

object OrthographicRecipe extends ProjectiveRecipe("orthographic", "parallel lines stay parallel"):
  protected def make()(using Site): CameraPlan = CameraPlan(
    (toWorld, frame) => OrthographicCamera(setup(toWorld, frame)),
    shutter()
  )
