package candela.mitsuba

import candela.diagnostics.Code
import candela.color.Rgb
import candela.math.{Transform, Vec3}
import candela.scenefile.{Declaration, Param, ParamType}

/** Translates the emitters "sunsky" and "timed_sunsky". */
final class Skies(session: Session, colors: Colors):

  /** A light, to be placed by the emitter's transform. */
  def apply(in: Properties, toWorld: Transform): Declaration =
    val toSun = in.triple("sun_direction").filter(_ => in.plugin.name == "sunsky") match
      case Some((x, y, z)) =>
        val conflicting = Skies.Times.filter(in.contains)
        if conflicting.nonEmpty then
          session.error(
            Code.ExclusiveParameters,
            in.posOf(conflicting.head),
            s"`sun_direction` and `${conflicting.head}` are mutually exclusive"
          )
        toWorld.inverse.vector(Vec3(x.toFloat, y.toFloat, z.toFloat)).normalized
      case None => SunPosition(if in.plugin.name == "sunsky" then fixed(in) else timed(in))
    if in.flag("complex_sun", false) then
      session.warn(
        Code.Unsupported,
        in.posOf("complex_sun"),
        "`complex_sun` is not supported; using a uniform disk"
      )
    val skyScale = checked(in, "sky_scale", 1, "at least 0")(_ >= 0)
    val sun = Seq(
      number(in, "sun_aperture", "sunaperture", 0.5358, "between 0 and 180")(x => x > 0 && x < 180),
      number(in, "sun_scale", "sunscale", 1, "at least 0")(_ >= 0)
    )
    val sky = params(in, toSun, Rgb.gray(0.3f), skyScale)
    session.declare("LightSource", "sunsky", in.pos, sky ++ sun)

  /** Those of the sky, and the sun's direction. */
  def params(in: Properties, toSun: Vec3, defaultAlbedo: Rgb, skyScale: Double): Seq[Param] =
    val albedo = colors.fixed(in, "albedo", defaultAlbedo, Role.Reflectance)
    if Seq(albedo.r, albedo.g, albedo.b).exists(c => !(c >= 0f && c <= 1f)) then
      session.error(Code.ParameterValue, in.posOf("albedo"), "`albedo` must be from 0 to 1")
    Seq(
      number(in, "turbidity", "turbidity", 3, "from 1 to 10")(x => x >= 1 && x <= 10),
      Param.float("skyscale", in.pos, skyScale.toFloat),
      Param.float("albedo", in.posOf("albedo"), albedo.r, albedo.g, albedo.b),
      Param.floats(ParamType.Vector3, "sun", in.pos, Array(toSun.x, toSun.y, toSun.z))
    )

  private def number(in: Properties, name: String, ours: String, default: Double, range: String)(
      isIn: Double => Boolean
  ): Param =
    val x = checked(in, name, default, range)(isIn)
    Param.float(ours, in.posOf(name), x.toFloat)

  private def checked(in: Properties, name: String, default: Double, range: String)(
      isIn: Double => Boolean
  ): Double =
    val x = in.number(name, default)
    if isIn(x) then x
    else
      session.error(Code.ParameterValue, in.posOf(name), s"`$name` must be $range, found $x")
      default

  /** When and where the sun is seen. */
  def fixed(in: Properties): PlaceAndTime =
    val hour = in.number("hour", 15) +
      (in.number("minute", 0) + in.number("second", 0) / 60) / 60
    placeAndTime(in, in.integer("year", 2010), in.integer("month", 7), in.integer("day", 10), hour)

  /** Each day of a period is the window between two hours. */
  private def timed(in: Properties): PlaceAndTime =
    val (year, month, day) =
      (in.integer("start_year", 2025), in.integer("start_month", 1), in.integer("start_day", 1))
    val end = placeAndTime(
      in,
      in.integer("end_year", year + 1),
      in.integer("end_month", month),
      in.integer("end_day", day),
      0
    )
    def hour(name: String, default: Double) =
      checked(in, name, default, "from 0 to 24")(x => x >= 0 && x <= 24)
    val (from, to) = (hour("window_start_time", 7), hour("window_end_time", 19))
    if from > to then
      session.error(
        Code.ParameterValue,
        in.posOf("window_end_time"),
        "`window_end_time` is before `window_start_time`"
      )
    val (open, close) = (in.number("shutter_open", 0), in.number("shutter_close", 1))
    if !(close > open) then
      session.error(
        Code.ParameterValue,
        in.posOf("shutter_close"),
        "`shutter_close` must be after `shutter_open`"
      )
    val count = SunPosition.days(end) - SunPosition.days(placeAndTime(in, year, month, day, 0))
    if count < 0 then
      session.error(
        Code.ParameterValue,
        in.pos,
        "the period of \"timed_sunsky\" ends before it begins"
      )
    val (first, last) = session.shutter
    if last > first then
      session.warn(
        Code.CorrectedValue,
        in.pos,
        "the sun can't move while the shutter is open; using its position at the middle of the time"
      )
    val passed = (0.5 * (first + last) - open) / (close - open) * Math.max(count, 1)
    val wholeDays = Math.floor(passed)
    placeAndTime(in, year, month, day + wholeDays.toInt, from + (to - from) * (passed - wholeDays))

  private def placeAndTime(
      in: Properties,
      year: Int,
      month: Int,
      day: Int,
      hour: Double
  ): PlaceAndTime =
    PlaceAndTime(
      year,
      month,
      day,
      hour,
      in.number("timezone", 9),
      in.number("latitude", 35.6894),
      in.number("longitude", 139.6917)
    )

object Skies:
  val Times: Seq[String] = Seq(
    "latitude", "longitude", "timezone", "year", "month", "day", "hour", "minute", "second"
  )
