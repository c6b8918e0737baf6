package candela.build.cameras

import candela.build.recipe.*
import candela.cameras.{FilmFrame, OrthographicCamera, PerspectiveCamera, ProjectiveSetup}
import candela.math.Transform
import candela.scenefile.Dialect

/** What cameras have that look at a film through one lens. */
abstract class ProjectiveRecipe(name: String, meaning: String, dialects: Set[Dialect] = every)
    extends CameraRecipe(name, meaning, dialects):
  private val aspect = float("frameaspectratio", "width over height", shown = "the image's")(0f)
  private val window =
    numbers(
      "screenwindow",
      "float[4]",
      "left right bottom top of the film",
      shown = "by the aspect"
    )
  private val lens =
    float("lensradius", "of the aperture; 0: a pinhole", unit = "scene units")(0f)
  private val focus =
    float("focaldistance", "to the plane in focus", unit = "scene units")(
      if v2 then 1e30f else 1e6f
    )
  noMeaning("pbrt-v1 had it; nothing is cut off")(
    float("hither", "nearest distance that is seen", onlyV2, "scene units")(1e-3f),
    float("yon", "farthest distance that is seen", onlyV2, "scene units")(1e30f)
  )

  protected def setup(toWorld: Transform, frame: FilmFrame)(using site: Site): ProjectiveSetup =
    val FilmFrame(width, height, _) = frame
    val ratio = if aspect() > 0f then aspect() else width.toFloat / height
    val screen = window() match
      case Array(l, r, b, t) => (l, r, b, t)
      case other =>
        if other.nonEmpty then site.error("`screenwindow` takes left right bottom top")
        ScreenWindow.of(ratio)
    ProjectiveSetup(toWorld, width, height, screen, lens(), focus())

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
