package candela.build

import candela.cameras.{Camera, OrthographicCamera, PerspectiveCamera, ProjectiveSetup}
import candela.math.*

/** Recipes of cameras; they want to know the film's width and height. */
object Cameras:
  val all: Recipes[(Transform, Int, Int) => Camera] = Recipes(
    "camera",
    Vector(Perspective, Orthographic),
    Vector("environment", "spherical", "realistic", "omni", "rtf")
      .map(_ -> "a perspective camera is used")
      .toMap
  )

  abstract class ProjectiveRecipe(name: String, meaning: String)
      extends Recipe[(Transform, Int, Int) => Camera](name, meaning):
    private val aspect = float("frameaspectratio", "width over height", shown = "the image's")(0f)
    private val window = numbers("screenwindow", "float[4]", "left right bottom top of the film")
    private val lens = float("lensradius", "of the aperture; 0: a pinhole")(0f)
    private val focus = float("focaldistance", "to the plane in focus")(if v4 then 1e6f else 1e30f)
    private val open = float("shutteropen", "time at which the shutter opens")(0f)
    private val close = float("shutterclose", "time at which the shutter closes")(1f)
    noMeaning("nothing is cut off")(
      float("hither", "nearest distance that is seen", onlyV2)(1e-3f),
      float("yon", "farthest distance that is seen", onlyV2)(1e30f)
    )

    protected def setup(toWorld: Transform, width: Int, height: Int)(using
        site: Site
    ): ProjectiveSetup =
      val _ = (open(), close())
      val ratio = if aspect() > 0f then aspect() else width.toFloat / height
      val screen = window() match
        case Array(l, r, b, t) => (l, r, b, t)
        case other =>
          if other.nonEmpty then site.error("`screenwindow` takes left right bottom top")
          if ratio > 1f then (-ratio, ratio, -1f, 1f) else (-1f, 1f, -1f / ratio, 1f / ratio)
      ProjectiveSetup(toWorld, width, height, screen, lens(), focus())

  object Perspective extends ProjectiveRecipe("perspective", "things far away look smaller"):
    private val fov = float("fov", "angle of the shorter side of the view, degrees")(90f)
    private val half = float("halffov", "half of `fov`", untilV3)(45f)
    protected def make()(using site: Site): (Transform, Int, Int) => Camera =
      val angle = half.given_().map(_ * 2f).getOrElse(fov())
      if !(angle > 0f && angle < 180f) then
        site.error(s"`fov` lies between 0 and 180 degrees; found $angle")
      (toWorld, width, height) =>
        PerspectiveCamera(setup(toWorld, width, height), clamp(angle, 1e-3f, 179.9f))

  object Orthographic extends ProjectiveRecipe("orthographic", "parallel lines stay parallel"):
    protected def make()(using Site): (Transform, Int, Int) => Camera =
      (toWorld, width, height) => OrthographicCamera(setup(toWorld, width, height))
