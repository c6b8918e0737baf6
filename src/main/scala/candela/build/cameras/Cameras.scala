package candela.build.cameras

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

/** A camera to be placed.
  *
  * @param make takes its transform and the film
  */
final case class CameraPlan(make: (Transform, FilmFrame) => Camera, shutter: Shutter)

/** What all cameras have. */
abstract class CameraRecipe(name: String, meaning: String, dialects: Set[Dialect] = every)
    extends Recipe[CameraPlan](name, meaning, dialects):
  private val open = float("shutteropen", "time at which the shutter opens", unit = "s")(0f)
  private val close = float("shutterclose", "time at which the shutter closes", unit = "s")(1f)

  protected def shutter()(using site: Site): Shutter =
    val (from, to) = (open(), close())
    if site.dialect == Dialect.V4 && !(to > from) then
      site.error(s"the shutter never opens: `shutterclose` must be above `shutteropen` in v4")
    if to < from then
      site.warn(s"the shutter closes at $to, before it opens at $from: the two are exchanged")
      Shutter(to, from)
    else Shutter(from, to)

private[build] object ScreenWindow:

  /** Its shorter side goes from -1 to 1. */
  def of(ratio: Float): (Float, Float, Float, Float) =
    if ratio > 1f then (-ratio, ratio, -1f, 1f) else (-1f, 1f, -1f / ratio, 1f / ratio)

/** A pinhole camera of 90 degrees, for what can't be made. */
private[build] object StandInCamera:
  val words = "a perspective camera of 90 degrees is used"

  def make(toWorld: Transform, frame: FilmFrame): Camera =
    val screen = ScreenWindow.of(frame.width.toFloat / frame.height)
    PerspectiveCamera(ProjectiveSetup(toWorld, frame.width, frame.height, screen, 0f, 1f), 90f)
