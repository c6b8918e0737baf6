package candela.build.recipe

import candela.diagnostics.Code
import candela.color.Rgb
import candela.math.Vec3
import candela.scenefile.{Dialect, Param, ParamType}

/** One parameter of a recipe: name, type, default, documentation and reader.
  *
  * @param typeName    the type as spelled in scene files, for documentation and messages
  * @param unit        unit of the values, or empty
  * @param range       the numbers that it takes, per dialect
  * @param default     default value, per dialect
  * @param defaultText default as text, per dialect
  * @param adapt       the default for a site
  */
class Field[T](
    val name: String,
    val typeName: String,
    val doc: String,
    val dialects: Set[Dialect],
    val unit: String,
    val range: Dialect => Range,
    val default: Dialect => T,
    val defaultText: Dialect => String,
    read: (Param, Site) => Option[T],
    adapt: (T, Site) => T
):
  private val plainType = ValueTypes.plain(typeName)

  /** Returns the value given at the site, else the default. Reports values of the wrong type. */
  def apply()(using site: Site): T = given_() match
    case Some(value) => value
    case None => adapt(default(site.dialect), site)

  /** Returns the value given by the scene file, if any. */
  def given_()(using site: Site): Option[T] = site.declaration.param(name) match
    case Some(p) if site.speaks(dialects) && fits(p, site) => held(p, site)
    case _ => None

  /** The value at a site whose statement has the parameter, of the type that was accepted of
    * another, which it is alike.
    */
  def again()(using site: Site): Option[T] = site.declaration.param(name).flatMap(held(_, site))

  private def held(p: Param, site: Site): Option[T] =
    val accepted = if Field.OfSpectra(p.paramType) then Range.Any else range(site.dialect)
    accepted.held(p, unit, site).flatMap(read(_, site))

  /** Whether pbrt finds the value, which it looks for by type. Mitsuba's reader knows the types of
    * recipes, not those of pbrt.
    */
  private def fits(p: Param, site: Site): Boolean =
    val fits = !site.rules.typed ||
      ValueTypes.accepts(plainType, name, p, site.dialect)
    if !fits && !p.isDefault then
      site.unread(
        Code.ParameterType,
        p,
        s"`$name` of \"${site.declaration.name}\" must be of type $typeName, found " +
          p.paramType.spelling,
        ValueTypes.example(typeName, p)
      )
    fits

private object Field:
  /** Spectra have wavelengths among their numbers, XYZ negative ones. */
  val OfSpectra: Set[ParamType] = Set(ParamType.Spectrum, ParamType.Xyz, ParamType.Blackbody)

/** Level of support for a parameter. */
enum Support:
  case Used

  /** Not supported: a warning names the replacement. */
  case Unsupported(instead: String)

  /** Accepted and ignored, because it can't affect the image. */
  case NoMeaning(reason: String)

/** Formats defaults in scene file syntax. */
private[build] object DefaultText:

  /** Shortest decimal that parses back to the same number; integers have no fraction. */
  def number(x: Float): String =
    if x == Float.PositiveInfinity then "infinite"
    else if x == Float.NegativeInfinity then "-infinite"
    else
      val decimal = java.math.BigDecimal(x.toString).stripTrailingZeros
      val size = Math.abs(x)
      if size < 1e6f && !(size > 0f && size < 1e-6f) then decimal.toPlainString
      else decimal.toString.replace("E+", "e").replace("E", "e")

  def quoted(s: String): String = "\"" + s + "\""

  def triple(v: Vec3): String = s"${number(v.x)} ${number(v.y)} ${number(v.z)}"

  /** Formats a grey as a single number. */
  def color(c: Rgb): String =
    if c.r == c.g && c.g == c.b then number(c.r)
    else s"${number(c.r)} ${number(c.g)} ${number(c.b)}"

  def spectrum(v: SpectralValue): String = v match
    case SpectralValue.Color(c, _) => color(c)
    case SpectralValue.Wavelengths(_) => "a spectrum"
