package candela.build.recipe

import candela.diagnostics.{Code, Suggest}
import candela.color.Rgb
import candela.math.Vec3
import candela.scenefile.{Dialect, Param, ParamType}
import candela.textures.{ConstantFloat, ConstantRgb, FloatTexture, RgbTexture}

/** Declares the parameters of a recipe, by type. A default may depend on the dialect:
  * `float("xradius", "…")(if v4 then 1.5f else 2f)`.
  */
trait Fields:
  protected def register[T](field: Field[T]): Field[T]

  protected final def v2(using d: Dialect): Boolean = d == Dialect.V2
  protected final def v3(using d: Dialect): Boolean = d == Dialect.V3
  protected final def v4(using d: Dialect): Boolean = d.base == Dialect.V4

  /** Declares parameters of one value of a type.
    *
    * @param typeName its name in scene files
    * @param text     a default, for the reference
    */
  protected final class ValueType[T](typeName: String, text: T => String)(
      read: (Param, Site) => Option[T]
  ):
    def apply(
        name: String,
        doc: String,
        in: Set[Dialect] = every,
        unit: String = "",
        shown: String = "",
        range: Dialect ?=> Range = Range.Any
    )(default: Dialect ?=> T): Field[T] =
      field(name, typeName, doc, in, unit, shown, range, default)(text)(read)

  protected final val float =
    ValueType[Float]("float", DefaultText.number)(floats(1, _, _).map(_(0)))

  protected final val integer = ValueType[Int]("integer", _.toString): (p, site) =>
    if p.paramType == ParamType.Integer && p.ints.length == 1 then Some(p.ints(0))
    else wrong(p, site, "one integer", "integer")

  protected final val bool = ValueType[Boolean]("bool", _.toString): (p, site) =>
    if p.paramType == ParamType.Bool && p.bools.size == 1 then Some(p.bools(0))
    else wrong(p, site, "one bool", "bool")

  protected final val string = ValueType[String]("string", DefaultText.quoted): (p, site) =>
    if p.paramType == ParamType.String && p.strings.size == 1 then Some(p.strings(0))
    else wrong(p, site, "one string", "string")

  protected final val point = ValueType[Vec3]("point3", DefaultText.triple)(triple)
  protected final val vector = ValueType[Vec3]("vector3", DefaultText.triple)(triple)

  private def triple(p: Param, site: Site): Option[Vec3] =
    floats(3, p, site).map(v => Vec3(v(0), v(1), v(2)))

  /** A string from a fixed set of values. Another one is an error, or a warning where this
    * dialect's pbrt uses its default.
    *
    * @param forgiven whether pbrt-v4 uses its default, as the older ones do
    * @param instead  what pbrt uses for it, if not the default
    */
  protected final def oneOf(
      name: String,
      doc: String,
      values: Seq[String],
      in: Set[Dialect] = every,
      forgiven: Boolean = false,
      instead: String = "",
      shown: String = ""
  )(default: Dialect ?=> String): Field[String] =
    val words = s"$doc: ${values.mkString(", ")}"
    field(name, "string", words, in, "", shown, Range.Any, default)(DefaultText.quoted):
      (p, site) =>
        if p.paramType != ParamType.String || p.strings.size != 1 then
          wrong(p, site, "one string", "string")
        else
          p.strings.headOption.filter(values.contains).orElse {
            val value = p.strings.headOption.getOrElse("")
            val message = s"`$name` must be one of ${values.mkString(", ")}, found \"$value\""
            val help = Suggest.nearest(value, values).map(v => s"did you mean `$v`?")
            if site.dialect == Dialect.V4 && !forgiven then
              site.problems.error(Code.ParameterValue, p.valuesAt, message, help)
            else
              val fallback = if instead.isEmpty then "the default" else s"\"$instead\""
              site.problems.warn(
                Code.ParameterValue,
                p.valuesAt,
                s"$message; using $fallback, as pbrt does",
                help
              )
            Option.when(instead.nonEmpty)(instead)
          }

  /** An array of numbers of any length; empty by default.
    *
    * @param typeName the type as spelled in scene files, with `[]` and the length if it is fixed
    */
  protected final def numbers(
      name: String,
      typeName: String,
      doc: String,
      in: Set[Dialect] = every,
      unit: String = "",
      shown: String = "none",
      range: Dialect ?=> Range = Range.Any
  ): Field[Array[Float]] =
    field(name, typeName, doc, in, unit, shown, range, Array.emptyFloatArray)(_ => ""): (p, site) =>
      if p.paramType == ParamType.Integer then Some(p.ints.map(_.toFloat))
      else if Fields.numeric(p.paramType) then Some(p.floats)
      else wrong(p, site, "numbers", typeName)

  protected final def integers(
      name: String,
      doc: String,
      in: Set[Dialect] = every,
      typeName: String = "integer[]",
      shown: String = "none"
  ): Field[Array[Int]] =
    field(name, typeName, doc, in, "", shown, Range.Any, Array.emptyIntArray)(_ => ""): (p, site) =>
      if p.paramType == ParamType.Integer then Some(p.ints)
      else wrong(p, site, "integers", "integer")

  /** An array of strings of any length; empty by default. */
  protected final def strings(
      name: String,
      typeName: String,
      doc: String,
      in: Set[Dialect] = every
  ): Field[Vector[String]] =
    field(name, typeName, doc, in, "", "none", Range.Any, Vector.empty[String])(_ => ""):
      (p, site) =>
        if p.paramType == ParamType.String then Some(p.strings)
        else wrong(p, site, "strings", "string")

  /** A colour that can't be textured: emission or an index of refraction. The default of emission
    * is in the colour space of the statement: 1 is the space's illuminant.
    */
  protected final def color(
      name: String,
      doc: String,
      role: SpectrumRole,
      in: Set[Dialect] = every,
      unit: String = "",
      shown: String = "",
      range: Option[Range] = None
  )(default: Dialect ?=> Rgb): Field[Rgb] =
    adapted(name, "spectrum", doc, in, unit, shown, range.getOrElse(ofColors(role)), default)(
      DefaultText.color,
      (c, site) => Spectra.default(c, role, site)
    )(Spectra.rgb(_, role, _))

  /** A function of wavelength, or a colour. */
  protected final def spectrum(
      name: String,
      doc: String,
      in: Set[Dialect] = every,
      unit: String = "",
      shown: String = "",
      typeName: String = "spectrum",
      range: Dialect ?=> Range = Range.Any
  )(default: Dialect ?=> SpectralValue): Field[SpectralValue] =
    field(name, typeName, doc, in, unit, shown, range, default)(DefaultText.spectrum)(
      Spectra.value(_, _)
    )

  protected final def floatTexture(
      name: String,
      doc: String,
      in: Set[Dialect] = every,
      unit: String = "",
      shown: String = "",
      range: Dialect ?=> Range = Range.Any
  )(default: Dialect ?=> Float): Field[FloatTexture] =
    field[FloatTexture](
      name, "float texture", doc, in, unit, shown, range, ConstantFloat(default)
    )(_.constant.fold("")(DefaultText.number)): (p, site) =>
      if p.paramType == ParamType.Texture then site.resources.floatTexture(p, site.problems)
      else firstFloat(p, site).map(ConstantFloat(_))

  protected final def rgbTexture(
      name: String,
      doc: String,
      in: Set[Dialect] = every,
      unit: String = "",
      shown: String = "",
      role: SpectrumRole = SpectrumRole.Reflectance
  )(default: Dialect ?=> Rgb): Field[RgbTexture] =
    def read(p: Param, site: Site): Option[RgbTexture] =
      if p.paramType == ParamType.Texture then site.resources.rgbTexture(p, site.problems)
      else Spectra.rgb(p, role, site).map(ConstantRgb(_))
    def forSite(texture: RgbTexture, site: Site) =
      texture.constant.fold(texture)(c => ConstantRgb(Spectra.default(c, role, site)))
    adapted[RgbTexture](
      name, "spectrum texture", doc, in, unit, shown, ofColors(role), ConstantRgb(default)
    )(_.constant.fold("")(DefaultText.color), forSite)(read)

  /** The components of colours: pbrt-v4 rejects others. */
  private def ofColors(role: SpectrumRole)(using Dialect): Range =
    if !v4 then Range.Any
    else if role == SpectrumRole.Reflectance then Range(0f, 1f).unclamped
    else Range.atLeast(0f).unclamped

  /** Constants of textures: pbrt-v2 and v3 take the first of several numbers. */
  private def firstFloat(p: Param, site: Site): Option[Float] =
    if p.floats.length > 1 && site.dialect != Dialect.V4 then
      site.problems.warn(
        Code.ParameterCount,
        p.valuesAt,
        s"`${p.name}` must be one number; the first is used, as in pbrt"
      )
      Some(p.floats(0))
    else floats(1, p, site).map(_(0))

  private def floats(count: Int, p: Param, site: Site): Option[Array[Float]] =
    val values =
      if p.paramType == ParamType.Integer then p.ints.map(_.toFloat)
      else if Fields.numeric(p.paramType) then p.floats
      else Array.emptyFloatArray
    if values.length == count then Some(values)
    else if count == 1 then wrong(p, site, "one number", "float")
    else wrong(p, site, s"$count numbers", "point3")

  private def wrong[T](p: Param, site: Site, expected: String, typeName: String): Option[T] =
    val count = Seq(p.floats.length, p.ints.length, p.bools.size, p.strings.size).max
    val plain = typeName.takeWhile(_ != '[')
    site.unread(
      Code.ParameterCount,
      p,
      s"`${p.name}` of \"${site.declaration.name}\" must be $expected, found " +
        s"$count of type ${p.paramType.spelling}",
      Option.when(plain != p.paramType.spelling)(s"write \"$plain ${p.name}\"")
    )
    None

  private def field[T](
      name: String,
      typeName: String,
      doc: String,
      in: Set[Dialect],
      unit: String,
      shown: String,
      range: Dialect ?=> Range,
      default: Dialect ?=> T
  )(text: T => String)(read: (Param, Site) => Option[T]): Field[T] =
    adapted(name, typeName, doc, in, unit, shown, range, default)(text, (value, _) => value)(read)

  /** As above, with a default that depends on the site. */
  private def adapted[T](
      name: String,
      typeName: String,
      doc: String,
      in: Set[Dialect],
      unit: String,
      shown: String,
      range: Dialect ?=> Range,
      default: Dialect ?=> T
  )(text: T => String, adapt: (T, Site) => T)(read: (Param, Site) => Option[T]): Field[T] =
    val written = (d: Dialect) => if shown.nonEmpty then shown else text(default(using d))
    val (ranges, defaults) = ((d: Dialect) => range(using d), (d: Dialect) => default(using d))
    register(Field(name, typeName, doc, in, unit, ranges, defaults, written, read, adapt))

object Fields:
  private[build] val numeric: Set[ParamType] = Set(
    ParamType.Float, ParamType.Point2, ParamType.Vector2, ParamType.Point3, ParamType.Vector3,
    ParamType.Normal, ParamType.Rgb
  )
