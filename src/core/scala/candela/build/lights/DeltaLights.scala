package candela.build.lights

import candela.build.recipe.*
import candela.color.Rgb
import candela.lights.*
import candela.math.*
import candela.scenefile.Dialect

/** Points of lights that may lie so far out that Floats are coarse. */
private object Places:

  /** The point in Double, if that makes a difference. */
  def far(name: String)(using site: Site): Option[Position] =
    val p = site.declaration.param(name).filter(_.floats.length == 3)
    val isMoved = !site.resources.origin.isOrigin
    p.filter(q => isMoved || q.rests.length > 0).map(_.position(0))

  def exact(p: Vec3): Position = Position(p.x, p.y, p.z)

  def rounded(p: Position): Vec3 = Vec3(p.x.toFloat, p.y.toFloat, p.z.toFloat)

  /** From one point to another. */
  def vectorBetween(a: String, from: Vec3, b: String, to: Vec3)(using
      Site
  ): Vec3 =
    val (p, q) = (far(a), far(b))
    if p.isEmpty && q.isEmpty then to - from
    else rounded(p.getOrElse(exact(from)).toOrigin.position(q.getOrElse(exact(to))))

object PointLightRecipe extends LightRecipe("point", "isotropic point light"):
  private val intensity =
    color("I", "radiant intensity", SpectrumRole.Emission, unit = "W/sr")(Rgb.White)
  private val position = point("from", "position")(Vec3.Zero)
  private val power =
    float("power", "total power, overrides the magnitude of `I`", onlyV4, "lm", "none")(-1f)

  protected def create()(using site: Site): LightPlan =
    val (i, p) = (scaled(intensity(), power(), 4f * Pi), position())
    val far = Places.far("from")
    // v2 and v3 translate by `from` after the transform, v4 before it
    def worldPoint(toWorld: Transform) = far match
      case Some(q) if site.dialect == Dialect.V4 => Places.rounded(toWorld.position(q))
      case Some(q) => Places.rounded((q.fromOrigin * toWorld).position(Position.Origin))
      case None if site.dialect == Dialect.V4 => toWorld.point(p)
      case None => toWorld.point(Vec3.Zero) + p
    if !shines(i) then LightPlan.leftOut(LightPlan.Black)
    else LightPlan((toWorld, _) => Some(PointLight(worldPoint(toWorld), i)), samples = 1)

object SpotLightRecipe extends LightRecipe("spot", "spotlight"):
  /** What pbrt-v4 does if the cone is stretched. */
  private[lights] val Cone = "selects it by its unscaled cone and shows nothing outside of that"
  private val intensity =
    color("I", "radiant intensity along the axis", SpectrumRole.Emission, unit = "W/sr")(Rgb.White)
  private val from = point("from", "position")(Vec3.Zero)
  private val to = point("to", "target of the axis")(Vec3.Z)
  private val cone =
    float(
      "coneangle",
      "angle between the axis and the edge of the cone",
      unit = "degrees",
      range = Range.above(0f).deferred
    )(30f)
  private val fading =
    float("conedeltaangle", "angular width of the falloff inside the edge", unit = "degrees")(5f)
  private val power =
    float("power", "total power, overrides the magnitude of `I`", onlyV4, "lm", "none")(-1f)
  private val falloff =
    oneOf(
      "falloff",
      "falloff inside the edge, by the cosine",
      Vector("square", "smoothstep"),
      onlyGltf
    )("square")
  private val slide =
    string(
      "mapname",
      "image that scales the light across the cone",
      onlyMitsuba,
      shown = "none"
    )("")
  declare(bool("raw", LightImages.Raw, onlyMitsuba)(false))

  protected def create()(using site: Site): LightPlan =
    val picture =
      if slide().isEmpty then None
      else LightImages.picture("mapname", PictureLookup.SmoothRepeating)
    val (edge, full) = (cos(radians(cone())), cos(radians(cone() - fading())))
    val i = scaled(intensity(), power(), SpotLight.solidAngle(edge, full))
    val p = Places.far("from").getOrElse(Places.exact(from()))
    val axis = Places.vectorBetween("from", from(), "to", to())
    val fade = if falloff() == "smoothstep" then Fade.Cubic else site.rules.fade
    ScaledLight.warn(onlyV4, _.nonEmpty, SpotLightRecipe.Cone)
    if !shines(i) then LightPlan.leftOut(LightPlan.Black)
    else if axis.isZero then LightPlan.leftOut("`from` and `to` are the same point")
    else if !(cone() > 0f) then LightPlan.leftOut(s"`coneangle` must be above 0, found ${cone()}")
    else if slide().nonEmpty && picture.isEmpty then LightPlan.nothing
    else
      LightPlan(
        (toWorld, _) =>
          val frame = LightFrame(toWorld * Transform.translate(p.x, p.y, p.z))
          Some(SpotLight(frame, axis.normalized, i, edge, full, fade, picture))
        ,
        samples = 1
      )

object DistantLightRecipe extends LightRecipe("distant", "directional light, such as the sun"):
  private val radiance =
    color(
      "L",
      "irradiance on a perpendicular plane",
      SpectrumRole.Emission,
      unit = "W/m²"
    )(Rgb.White)
  private val from = point("from", "start of the direction of light")(Vec3.Zero)
  private val to = point("to", "end of the direction of light")(Vec3.Z)
  private val illuminance =
    float("illuminance", "illuminance on a perpendicular plane, overrides the magnitude of `L`",
      onlyV4, "lx", "none")(-1f)

  protected def create()(using site: Site): LightPlan =
    val l = scaled(radiance(), illuminance(), 1f)
    val d = Places.vectorBetween("to", to(), "from", from())
    if d.isZero then LightPlan.leftOut("`from` and `to` are the same point")
    else if !shines(l) then LightPlan.leftOut(LightPlan.Black)
    else
      LightPlan(
        (toWorld, _) => Some(DistantLight(toWorld.vector(d).normalized, l)),
        samples = 1
      )
