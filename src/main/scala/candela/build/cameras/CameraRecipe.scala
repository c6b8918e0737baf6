package candela.build

import candela.cameras.{Camera, PerspectiveCamera, ProjectiveSetup}
import candela.math.Transform
import candela.scenefile.Dialect

/** A camera to be placed.
  *
  * @param make     takes its transform, and the film's width and height
  * @param exposure how long the shutter is open: v4's images are the brighter for it
  */
final case class CameraPlan(make: (Transform, Int, Int) => Camera, exposure: Float)

/** What all cameras have. */
abstract class CameraRecipe(name: String, meaning: String, dialects: Set[Dialect] = every)
    extends Recipe[CameraPlan](name, meaning, dialects):
  private val open = float("shutteropen", "time at which the shutter opens", unit = "s")(0f)
  private val close = float("shutterclose", "time at which the shutter closes", unit = "s")(1f)

  /** How long the shutter is open. */
  protected def exposure()(using site: Site): Float =
    val time = close() - open()
    if site.dialect == Dialect.V4 && !(time > 0f) then
      site.error(s"the shutter never opens: `shutterclose` must be above `shutteropen` in v4")
    Math.abs(time)

/** What cameras have that look at a film through one lens. */
abstract class ProjectiveRecipe(name: String, meaning: String, dialects: Set[Dialect] = every)
    extends CameraRecipe(name, meaning, dialects):
  private val isPanorama = name == "environment" || name == "spherical"
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
      if v2 || isPanorama then 1e30f else 1e6f
    )
  noMeaning("pbrt-v1 had it; nothing is cut off")(
    float("hither", "nearest distance that is seen", onlyV2, "scene units")(1e-3f),
    float("yon", "farthest distance that is seen", onlyV2, "scene units")(1e30f)
  )

  protected def setup(toWorld: Transform, width: Int, height: Int)(using
      site: Site
  ): ProjectiveSetup =
    val ratio = if aspect() > 0f then aspect() else width.toFloat / height
    val screen = window() match
      case Array(l, r, b, t) => (l, r, b, t)
      case other =>
        if other.nonEmpty then site.error("`screenwindow` takes left right bottom top")
        ScreenWindow.of(ratio)
    ProjectiveSetup(toWorld, width, height, screen, lens(), focus())

private[build] object ScreenWindow:

  /** Its shorter side goes from -1 to 1. */
  def of(ratio: Float): (Float, Float, Float, Float) =
    if ratio > 1f then (-ratio, ratio, -1f, 1f) else (-1f, 1f, -1f / ratio, 1f / ratio)

/** Of cameras that are not rendered yet. */
trait PerspectiveInstead extends CameraRecipe:
  override def pending: Option[String] = Some("a perspective camera of 90 degrees is used")
  protected def make()(using Site): CameraPlan = CameraPlan(
    (toWorld, width, height) =>
      val screen = ScreenWindow.of(width.toFloat / height)
      PerspectiveCamera(ProjectiveSetup(toWorld, width, height, screen, 0f, 1f), 90f)
    ,
    exposure()
  )
