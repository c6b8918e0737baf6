package candela.build.cameras

import candela.diagnostics.Code
import candela.build.recipe.*
import candela.cameras.{
  Camera, ClippedCamera, FilmFrame, OrthographicCamera, PerspectiveCamera, ProjectiveSetup
}
import candela.math.Transform
import candela.scenefile.Dialect

/** Base of cameras with a single thin lens. */
abstract class ProjectiveRecipe(name: String, meaning: String, dialects: Set[Dialect] = every)
    extends CameraRecipe(name, meaning, dialects):
  private val aspect =
    float(
      "frameaspectratio",
      "aspect ratio, width over height",
      shown = "the image's",
      range = Range.above(0f).deferred
    )(0f)
  private val window =
    numbers(
      "screenwindow",
      "float[4]",
      "left right bottom top of the screen window",
      shown = "by the aspect"
    )
  private val lens =
    float(
      "lensradius",
      "radius of the aperture; 0: pinhole",
      unit = "scene units",
      range = Range.atLeast(0f).limited
    )(0f)
  private val focus =
    float(
      "focaldistance",
      "distance to the plane in focus",
      unit = "scene units",
      range = Range.above(0f).unclamped
    )(
      if v2 then 1e30f else 1e6f
    )
  noMeaning("parameter of pbrt-v1; nothing is clipped")(
    float("hither", "near clipping distance", onlyV2, "scene units")(1e-3f),
    float("yon", "far clipping distance", onlyV2, "scene units")(1e30f)
  )

  private val near =
    float(
      "nearclip", "near clipping distance", onlyOthers, "scene units", range = Range.above(0f)
    )(0.01f)
  private val far =
    float(
      "farclip", "far clipping distance", onlyOthers, "scene units", range = Range.above(0f)
    )(1e4f)

  /** The camera, which clips if it is to. */
  protected def clipped(toWorld: Transform, camera: Camera)(using site: Site): Camera =
    if !site.rules.clips then camera
    else
      val (first, last) = (near(), far())
      if !(first < last) then
        site.error(Code.ParameterValue, s"clipping distances must rise, found $first and $last")
      ClippedCamera(camera, toWorld, first, last)

  protected def setup(toWorld: Transform, frame: FilmFrame)(using site: Site): ProjectiveSetup =
    val FilmFrame(width, height, _) = frame
    val ratio = if aspect() > 0f then aspect() else width.toFloat / height
    val screen = window() match
      case Array(l, r, b, t) => (l, r, b, t)
      case other =>
        val count = other.length
        if count > 0 then
          site.warn(
            Code.CorrectedValue,
            s"`screenwindow` must be left right bottom top, found $count numbers; it is ignored, " +
              "as pbrt does"
          )
        ScreenWindow.of(ratio)
    ProjectiveSetup(toWorld, width, height, screen, lens(), focus())

object PerspectiveRecipe extends ProjectiveRecipe("perspective", "perspective projection"):
  private val fov = float(
    "fov",
    "field of view along the shorter side",
    unit = "degrees",
    range = Range.exclusive(0f, 180f).unclamped
  )(90f)
  private val halfFov =
    float(
      "halffov",
      "half of `fov`, instead of `fov`",
      untilV3,
      "degrees",
      "none",
      Range.exclusive(0f, 90f).deferred
    )(-1f)

  protected def create()(using Site): CameraPlan =
    val angle = if halfFov() > 0f then 2f * halfFov() else fov()
    // A screen at infinity, or one behind the camera, has an image, too
    val turned = Math.abs(angle) % 360f
    val isAngle = angle > 0f && angle < 180f
    CameraPlan(
      (toWorld, frame) =>
        val fits =
          if isAngle then angle
          else if turned == 0f then PerspectiveRecipe.Narrowest
          else if turned == 180f then 180f - PerspectiveRecipe.Narrowest
          else angle
        clipped(toWorld, PerspectiveCamera(setup(toWorld, frame), fits))
      ,
      shutter()
    )

  /** Field of view that renders as 0 does, in degrees. */
  private val Narrowest = 0.001f

object OrthographicRecipe extends ProjectiveRecipe("orthographic", "orthographic projection"):
  protected def create()(using Site): CameraPlan = CameraPlan(
    (toWorld, frame) => clipped(toWorld, OrthographicCamera(setup(toWorld, frame))),
    shutter()
  )
