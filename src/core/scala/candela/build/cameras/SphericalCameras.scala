package candela.build.cameras

import candela.build.recipe.*
import candela.cameras.SphericalCamera
import candela.lights.{EqualAreaMap, LatLongMap}
import candela.scenefile.Dialect

/** Base of panoramic cameras. */
abstract class PanoramaRecipe(name: String, meaning: String, dialects: Set[Dialect])
    extends CameraRecipe(name, meaning, dialects):
  noMeaning("the image covers all directions")(
    float("frameaspectratio", "aspect ratio, width over height", shown = "the image's")(0f),
    numbers(
      "screenwindow",
      "float[4]",
      "left right bottom top of the screen window",
      shown = "by the aspect"
    ),
    float("hither", "near clipping distance", onlyV2, "scene units")(1e-3f),
    float("yon", "far clipping distance", onlyV2, "scene units")(1e30f)
  )
  noMeaning("everything is in focus")(
    float("lensradius", "radius of the aperture; 0: pinhole", unit = "scene units")(0f),
    float("focaldistance", "distance to the plane in focus", unit = "scene units")(1e30f)
  )

object EnvironmentRecipe
    extends PanoramaRecipe(
      "environment",
      "panorama as an equirectangular map",
      untilV3
    ):
  protected def create()(using site: Site): CameraPlan =
    val step = if site.dialect == Dialect.V2 then 1f else 0.05f
    CameraPlan(SphericalCamera(_, _, LatLongMap, folds = false, step), shutter())

object SphericalRecipe extends PanoramaRecipe("spherical", "spherical panorama", onlyV4):
  private val mapping =
    oneOf("mapping", "layout of the image", Vector("equalarea", "equirectangular"))("equalarea")

  protected def create()(using Site): CameraPlan =
    val isEqualArea = mapping() == "equalarea"
    val map = if isEqualArea then EqualAreaMap else LatLongMap
    CameraPlan(SphericalCamera(_, _, map, folds = isEqualArea), shutter())
