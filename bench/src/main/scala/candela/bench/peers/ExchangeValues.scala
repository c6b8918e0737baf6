package candela.bench.peers

import candela.color.{Colorimetry, Rgb, Spectrum}
import candela.color.Colorimetry.White
import candela.convert.Values
import candela.scenefile.{Declaration, Dialect, Param, ParamType}

import java.util.Locale

/** Reads parameters of pbrt-v4's statements as numbers and as red, green and blue.
  *
  * @param reject receives what can't be expressed
  */
private[peers] final class ExchangeValues(val reject: String => Unit):
  private val values = Values(Dialect.V4, Dialect.V3, (_, why) => reject(why))

  /** Any other parameter can't be expressed. */
  def rejectOthers(d: Declaration, names: String*): Unit =
    for p <- d.params if !names.contains(p.name) && !p.isDefault do
      reject(s"`${p.name}` of ${statement(d)}")

  def statement(d: Declaration): String = s"${d.category.toLowerCase(Locale.ROOT)} \"${d.name}\""

  def number(d: Declaration, name: String, default: Float): Float =
    d.param(name) match
      case None => default
      case Some(p) if p.floats.length == 1 && p.paramType == ParamType.Float => p.floats(0)
      case _ =>
        reject(s"`$name` of ${statement(d)}, unless a number")
        default

  def color(d: Declaration, p: Param): Rgb =
    if p.paramType == ParamType.Rgb && d.colorSpaceOf(p) != "srgb" then
      reject(s"colour space ${d.colorSpaceOf(p)}")
    values.color(p, d).getOrElse:
      reject(s"`${p.name}` of ${statement(d)}")
      Rgb.White

  /** Index of refraction at 589 nm. */
  def index(d: Declaration, name: String, default: Float): Float = d.param(name) match
    case Some(p) if p.paramType == ParamType.Spectrum =>
      values.spectrum(p, d).fold(default): s =>
        if s.values.distinct.length > 1 then reject(s"dispersion of ${statement(d)}")
        s(589.3f)
    case _ => number(d, name, default)

  /** An emitter's colour times its `scale`; pbrt-v4 normalises all spectra but RGB to luminance
    * 1.
    */
  def light(d: Declaration, name: String): Rgb =
    val c = d.param(name).fold(Rgb.White): p =>
      p.paramType match
        case ParamType.Rgb => color(d, p)
        case ParamType.Blackbody =>
          val body = Colorimetry.rgb(Spectrum.blackbody(p.floats(0)), White.EqualEnergy)
          body * (1f / body.luminance)
        case _ => values.spectrum(p, d).fold(color(d, p))(Colorimetry.unitLuminance(_))
    (c * number(d, "scale", 1f)).map(Math.max(_, 0f))

  def rgbElement(name: String, c: Rgb): String =
    s"""<rgb name="$name" value="${c.r} ${c.g} ${c.b}"/>"""
