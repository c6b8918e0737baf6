package candela.build

import candela.color.Rgb
import candela.lights.{DistantLight, PointLight}
import candela.math.*

object PointLights extends LightRecipe("point", "shines from a point to all sides"):
  private val intensity =
    color("I", "radiant intensity", SpectrumRole.Emission, unit = "W/sr")(Rgb.White)
  private val from = point("from", "where it is")(Vec3.Zero)
  private val power = float("power", "total, instead of the size of `I`", onlyV4, "lm", "none")(-1f)

  protected def make()(using Site): LightPlan =
    val wanted = if power() > 0f then Rgb.gray(power() / (4f * Pi)) else Rgb.White
    val (i, p) = (scaled(intensity()) * wanted, from())
    LightPlan((toWorld, _) => Some(PointLight(toWorld.point(p), i)), samples = 1)

object DistantLights extends LightRecipe("distant", "parallel light, as the sun's"):
  private val radiance =
    color("L", "irradiance on a facing plane", SpectrumRole.Emission, unit = "W/m²")(Rgb.White)
  private val from = point("from", "with `to`: the direction of light")(Vec3.Zero)
  private val to = point("to", "where it shines to")(Vec3.Z)
  private val illuminance =
    float("illuminance", "on a facing plane, instead of the size of `L`", onlyV4, "lx", "none")(-1f)

  protected def make()(using site: Site): LightPlan =
    val lit = if illuminance() > 0f then Rgb.gray(illuminance()) else Rgb.White
    val (l, d) = (scaled(radiance()) * lit, from() - to())
    if d.isZero then site.error("`from` and `to` of a distant light are the same point")
    LightPlan(
      (toWorld, _) => Option.when(!d.isZero)(DistantLight(toWorld.vector(d).normalized, l)),
      samples = 1
    )
