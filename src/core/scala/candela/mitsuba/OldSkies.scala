package candela.mitsuba

import candela.diagnostics.Code
import candela.color.Rgb
import candela.math.{Transform, Vec3}
import candela.scenefile.{GraphicsState, LightDescription, Param, ParamType}

/** Translates Mitsuba 0.6's emitters "sky", "sun" and "sunsky": the sky of Hošek and Wilkie, and
  * the sun of Preetham et al.
  */
private[mitsuba] final class OldSkies(session: Session, skies: Skies):

  def apply(in: Properties): Vector[LightDescription] =
    in.ignore("resolution", "sampling_weight")
    val toWorld = in.transform("to_world") * OldSkies.Axes
    val scale = in.number("scale", 1)
    val (sunScale, skyScale) = in.plugin.name match
      case "sky" => (0.0, scale)
      case "sun" => (scale, 0.0)
      case _ => (in.number("sun_scale", scale), in.number("sky_scale", scale))
    val toSun = direction(in, toWorld)
    val params = skies.params(in, toSun, Rgb.gray(0.2f), skyScale) ++ disk(in, toSun, sunScale)
    if in.number("stretch", 1) != 1 then
      in.warnUnsupported("the sky ends at the horizon", "stretch")
    if in.flag("extend", false) then in.warnUnsupported("the sky ends at the horizon", "extend")
    def light(name: String, params: Seq[Param]) =
      val statement = session.declare("LightSource", name, in.pos, params)
      LightDescription(statement, GraphicsState.constant(toWorld), "")
    val radius = in.number("sun_radius_scale", 1)
    if radius < 0 then
      session.error(
        Code.ParameterValue,
        in.posOf("sun_radius_scale"),
        s"`sun_radius_scale` must be at least 0, found $radius"
      )
    if radius > 0 || sunScale == 0 || !(toSun.z >= 0f) then Vector(light("sunsky", params))
    else
      // A sun without extent
      val ray = Seq("from" -> toSun, "to" -> Vec3.Zero).map: (name, p) =>
        Param.floats(ParamType.Point3, name, in.pos, Array(p.x, p.y, p.z))
      val sun = light("distant", Textures.rgb("L", irradiance(in, toSun, sunScale), in.pos) +: ray)
      if skyScale == 0 then Vector(sun)
      else Vector(light("sunsky", params), sun)

  private def direction(in: Properties, toWorld: Transform): Vec3 =
    in.triple("sun_direction") match
      case Some((x, y, z)) =>
        for name <- Skies.Times; p <- in.property(name) do
          session.warn(
            Code.IdleParameter,
            p.pos,
            s"`$name` is ignored: the direction of the sun is given"
          )
        toWorld.inverse.vector(Vec3(x.toFloat, y.toFloat, z.toFloat)).normalized
      case None => SunPosition(skies.fixed(in))

  /** The disk of the sun, whose power does not depend on its size. */
  private def disk(in: Properties, toSun: Vec3, scale: Double): Seq[Param] =
    val radius = in.number("sun_radius_scale", 1)
    val sunIrradiance = if radius > 0 then irradiance(in, toSun, scale) else Rgb.Black
    val angle = OldSkies.SunDegrees * (if radius > 0 then radius else 1)
    Seq(
      Param.float("sunscale", in.pos, if radius > 0 && scale > 0 then 1f else 0f),
      Param.float("sunaperture", in.posOf("sun_radius_scale"), Math.min(angle, 179).toFloat),
      Param.float("sunirradiance", in.pos, sunIrradiance.r, sunIrradiance.g, sunIrradiance.b)
    )

  private def irradiance(in: Properties, toSun: Vec3, scale: Double): Rgb =
    val zenithAngle = Math.acos(Math.max(0.0, Math.min(1.0, toSun.z.toDouble)))
    val solidAngle = 2 * Math.PI * (1 - Math.cos(Math.toRadians(OldSkies.SunDegrees / 2)))
    PreethamSun.radiance(zenithAngle, in.number("turbidity", 3)) * (solidAngle * scale).toFloat

private object OldSkies:
  private val SunDegrees = 0.5358

  /** +y is the zenith, −z north and +x east; Mitsuba 3 has +z, −x and −y. */
  private val Axes =
    Transform.fromRows(Vector(0, -1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1)).get
