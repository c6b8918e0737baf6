package candela.build.lights

import candela.build.recipe.*
import candela.color.Rgb
import candela.lights.{LightFrame, SkyModel, SunAndSky}
import candela.math.*

object SunskyLightRecipe
    extends LightRecipe("sunsky", "clear sky and sun", onlyOthers):
  private val turbidity = float("turbidity", "turbidity of the air", range = Range(1f, 10f))(3f)
  private val albedo =
    numbers(
      "albedo",
      "float[3]",
      "red, green and blue albedo of the ground",
      shown = "0.3 0.3 0.3",
      range = Range(0f, 1f)
    )
  private val toSun =
    vector("sun", "direction towards the sun; +z: the zenith, +x: north")(Vec3.Z)
  private val aperture =
    float(
      "sunaperture",
      "angle that the sun subtends",
      unit = "degrees",
      range = Range.exclusive(0f, 180f)
    )(0.5358f)
  private val sunScale =
    float("sunscale", "scale of the sun's radiance", range = Range.atLeast(0f))(1f)
  private val sunIrradiance = numbers(
    "sunirradiance",
    "float[3]",
    "irradiance by the sun",
    shown = "the model's",
    range = Range.atLeast(0f)
  )
  private val skyScale =
    float("skyscale", "scale of the sky's radiance", range = Range.atLeast(0f))(1f)

  private val isInView = bool("inview", "whether the camera sees it", onlyGltf)(true)

  protected def create()(using site: Site): LightPlan =
    val ground = albedo() match
      case Array(r, g, b) => Rgb(r, g, b)
      case _ => Rgb.gray(0.3f)
    val s = toSun().normalized
    if !(s.z >= 0f) then LightPlan.leftOut("the sun is below the horizon")
    else if sunScale() == 0f && skyScale() == 0f then LightPlan.leftOut(LightPlan.Black)
    else
      val scaling = scaled(Rgb.White)
      val basis = site.resources.basis
      val convert = if basis.isSpectral then basis.lookUpLight else basis.fromSrgb
      val elevation = Math.asin(Math.min(1.0, s.z.toDouble)).toFloat
      val model = SkyModel(turbidity(), ground, elevation)
      LightPlan(
        (toWorld, finds) =>
          val frame = LightFrame(toWorld)
          val halfAngle = Math.toRadians(aperture() / 2.0).toFloat
          Some(
            SunAndSky(
              frame,
              model,
              s,
              halfAngle,
              skyScale(),
              sunIrradiance() match
                case Array(r, g, b) => Rgb(r, g, b) * sunScale()
                case _ => model.sunIrradiance * sunScale()
              ,
              c => convert(c) * scaling,
              complete = finds != SkySampling.Bright,
              isInView = isInView()
            )
          )
        ,
        samples = 1
      )
