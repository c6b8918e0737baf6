package candela.build.lights

import candela.diagnostics.Code
import candela.build.recipe.*
import candela.color.Rgb
import candela.lights.{LightFrame, SkyModel, SunAndSky}
import candela.math.*

object SunskyLightRecipe
    extends LightRecipe("sunsky", "clear sky and sun", onlyMitsuba):
  private val turbidity = float("turbidity", "turbidity of the air, 1 to 10")(3f)
  private val albedo =
    numbers("albedo", "float[3]", "red, green and blue albedo of the ground", shown = "0.3 0.3 0.3")
  private val toSun =
    vector("sun", "direction towards the sun; +z: the zenith, +x: north")(Vec3.Z)
  private val aperture =
    float("sunaperture", "angle that the sun subtends", unit = "degrees")(0.5358f)
  private val sunScale = float("sunscale", "scale of the sun's radiance")(1f)
  private val sunIrradiance =
    numbers("sunirradiance", "float[3]", "irradiance by the sun", shown = "the model's")
  private val skyScale = float("skyscale", "scale of the sky's radiance")(1f)

  protected def make()(using site: Site): LightPlan =
    val ground = albedo() match
      case Array(r, g, b) => Rgb(r, g, b)
      case _ => Rgb.gray(0.3f)
    val s = toSun().normalized
    val wrong = Seq(
      Option.when(!(turbidity() >= 1f && turbidity() <= 10f))(
        s"`turbidity` must be from 1 to 10, found ${DefaultText.number(turbidity())}"
      ),
      Option.when(!Seq(ground.r, ground.g, ground.b).forall(c => c >= 0f && c <= 1f))(
        "`albedo` must be from 0 to 1"
      ),
      Option.when(!(aperture() > 0f && aperture() < 180f))(
        s"`sunaperture` must be between 0 and 180 degrees, found ${DefaultText.number(aperture())}"
      ),
      Option.when(!(sunScale() >= 0f && skyScale() >= 0f))(
        "`sunscale` and `skyscale` must not be negative"
      )
    ).flatten
    wrong.foreach(site.error(Code.ParameterValue, _))
    if wrong.nonEmpty then LightPlan.nothing
    else if !(s.z >= 0f) then LightPlan.leftOut("the sun is below the horizon")
    else if sunScale() == 0f && skyScale() == 0f then LightPlan.leftOut(LightPlan.Black)
    else
      val all = scaled(Rgb.White)
      val basis = site.resources.basis
      val convert = if basis.isSpectral then basis.lookUpLight else basis.fromSrgb
      val elevation = Math.asin(Math.min(1.0, s.z.toDouble)).toFloat
      val model = SkyModel(turbidity(), ground, elevation)
      LightPlan(
        (toWorld, finds) =>
          val frame = LightFrame(toWorld)
          val half = Math.toRadians(aperture() / 2.0).toFloat
          Some(
            SunAndSky(
              frame,
              model,
              s,
              half,
              skyScale(),
              sunIrradiance() match
                case Array(r, g, b) => Rgb(r, g, b) * sunScale()
                case _ => model.sunIrradiance * sunScale()
              ,
              c => convert(c) * all,
              complete = finds != SkySampling.Bright
            )
          )
        ,
        samples = 1
      )
