package candela.build

import candela.color.Rgb
import candela.math.Vec3

object SpotLights extends LightRecipe("spot", "a cone of light from a point") with Dark:
  declare(
    color("I", "radiant intensity along the axis", SpectrumRole.Emission, unit = "W/sr")(Rgb.White),
    point("from", "where it is")(Vec3.Zero),
    point("to", "a point on the axis")(Vec3.Z),
    float("coneangle", "between axis and edge", unit = "degrees")(30f),
    float("conedeltaangle", "over which light fades towards the edge", unit = "degrees")(5f),
    float("power", "total, instead of the size of `I`", onlyV4, "lm", "none")(-1f)
  )

object GoniometricLights
    extends LightRecipe("goniometric", "shines from a point, by an image of directions")
    with Dark:
  declare(
    color("I", "factor of the image", SpectrumRole.Emission, unit = "W/sr")(Rgb.White),
    string("mapname", "equirectangular image", untilV3, "none")(""),
    string("filename", "equal-area octahedral image", onlyV4, "none")(""),
    float("power", "total, instead of the size of `I`", onlyV4, "lm", "none")(-1f)
  )

object ProjectionLights extends LightRecipe("projection", "a slide projector") with Dark:
  declare(
    color("I", "factor of the image", SpectrumRole.Emission, untilV3, "W/sr")(Rgb.White),
    string("mapname", "the slide", untilV3, "none")(""),
    string("filename", "the slide", onlyV4, "none")(""),
    float("fov", "angle of the shorter side", unit = "degrees")(if v4 then 90f else 45f),
    float("power", "total, instead of the size of the image", onlyV4, "lm", "none")(-1f)
  )
