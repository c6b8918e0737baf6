package candela.build.cameras

import candela.diagnostics.Code
import candela.build.recipe.*
import candela.cameras.{Camera, FilmFrame, PerspectiveCamera, ProjectiveSetup, Shutter}
import candela.math.Transform
import candela.scenefile.Dialect

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

/** A camera before placement.
  *
  * @param create creates the camera from its transform and the film
  */
final case class CameraPlan(create: (Transform, FilmFrame) => Camera, shutter: Shutter)

/** Base of camera recipes. */
abstract class CameraRecipe(name: String, meaning: String, dialects: Set[Dialect] = every)
    extends Recipe[CameraPlan](name, meaning, dialects):
  private val open = float("shutteropen", "shutter opening time", unit = "s")(0f)
  private val close = float("shutterclose", "shutter closing time", unit = "s")(1f)

  protected def shutter()(using site: Site): Shutter =
    val (from, to) = (open(), close())
    // Mitsuba, too, renders an instant
    val isRefused = site.rules.dialect match
      case Dialect.V4 => !(to > from)
      case Dialect.Mitsuba => to < from
      case _ => false
    if isRefused then
      val message = s"the shutter must close after it opens, found $to and $from"
      site.error(Code.ParameterValue, message)
    else if to < from then
      site.warn(
        Code.CorrectedValue,
        s"`shutterclose` $to is before `shutteropen` $from; swapping them"
      )
    Shutter(Math.min(from, to), Math.max(from, to))

private[build] object ScreenWindow:

  /** Screen window whose shorter side spans -1 to 1. */
  def of(ratio: Float): (Float, Float, Float, Float) =
    if ratio > 1f then (-ratio, ratio, -1f, 1f) else (-1f, 1f, -1f / ratio, 1f / ratio)

/** Fallback for unsupported or invalid cameras: a pinhole camera of 90 degrees. */
private[build] object StandInCamera:
  val words = "using a perspective camera of 90 degrees"

  def create(toWorld: Transform, frame: FilmFrame): Camera =
    val screen = ScreenWindow.of(frame.width.toFloat / frame.height)
    PerspectiveCamera(ProjectiveSetup(toWorld, frame.width, frame.height, screen, 0f, 1f), 90f)
