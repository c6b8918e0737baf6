package candela.build.recipe

import candela.color.Rgb
import candela.math.Vec3
import candela.scenefile.{Dialect, Param}

/** One parameter of a recipe: its name, type, default and meaning, and how to read it.
  *
  * @param typeName how scene files spell its type, for documentation and messages
  * @param unit     of the values, or empty
  * @param default  by dialect
  * @param shown    the default as text, by dialect
  */
final class Field[T](
    val name: String,
    val typeName: String,
    val doc: String,
    val dialects: Set[Dialect],
    val unit: String,
    val default: Dialect => T,
    val shown: Dialect => String,
    read: (Param, Site) => Option[T]
):
  /** The value given at the site, else the default. A value of the wrong type is reported. */
  def apply()(using site: Site): T = given_().getOrElse(default(site.dialect))

  /** The value, if the scene file gives one. */
  def given_()(using site: Site): Option[T] =
    site.declaration.param(name).filter(_ => dialects(site.dialect)).flatMap(read(_, site))

/** What Candela does with a parameter. */
enum Support:
  case Used

  /** Not supported yet: the scene gets a warning that says what is done instead. */
  case NotYet(instead: String)

  /** It can't change the picture here: accepted for this reason. */
  case NoMeaning(reason: String)

/** Defaults as a scene file would write them. */
private[build] object DefaultText:

  /** The shortest decimals that read back as the same number; whole numbers have none. */
  def number(x: Float): String =
    if x == Float.PositiveInfinity then "infinite"
    else if x == Float.NegativeInfinity then "-infinite"
    else
      val decimal = java.math.BigDecimal(x.toString).stripTrailingZeros
      if Math.abs(x) < 1e6f then decimal.toPlainString else decimal.toString.replace("E+", "e")

  def quoted(s: String): String = "\"" + s + "\""

  def triple(v: Vec3): String = s"${number(v.x)} ${number(v.y)} ${number(v.z)}"

  /** One number for a grey. */
  def color(c: Rgb): String =
    if c.r == c.g && c.g == c.b then number(c.r)
    else s"${number(c.r)} ${number(c.g)} ${number(c.b)}"

  def spectrum(v: SpectralValue): String = v match
    case SpectralValue.Color(c) => color(c)
    case SpectralValue.Wavelengths(_) => "a spectrum"
