package candela.mitsuba

import candela.diagnostics.{Code, SourcePos}
import candela.color.{Colorimetry, Rgb, Spectrum}
import candela.math.clamp
import candela.scenefile.{Param, ParamType}

/** How spectra become colours: as in Mitsuba's RGB variants. */
enum Role:
  /** Lit by D65: a constant 1 is white. In [0, 1], where the spectrum is not. Numbers of surfaces
    * and coefficients of media, too.
    */
  case Reflectance

  /** As reflectance, but without an upper limit: indices of metals, absorption of hair, volumes. */
  case Unbounded

  /** A number or a colour of 1 is white; a spectrum is as measured. */
  case Emission

  private[mitsuba] def color(s: Spectrum): Rgb = this match
    case Reflectance => Colorimetry.rgb(s, Colorimetry.White.D65).map(clamp(_, 0f, 1f))
    case Unbounded => Colorimetry.rgb(s, Colorimetry.White.D65).map(Math.max(_, 0f))
    case Emission => Colorimetry.rgb(s, Colorimetry.White.EqualEnergy)

/** A colour or a texture. */
enum Shade:
  /** @param light the spectrum that has the colour, if light is given by one */
  case Constant(c: Rgb, light: Option[Spectrum] = None)
  case Textured(texture: Plugin)

  /** The colour, if it is constant. */
  def constant: Option[Rgb] = this match
    case Constant(c, _) => Some(c)
    case Textured(_) => None

/** Reads colours. */
final class Colors(session: Session):

  def shade(in: Properties, name: String, default: Rgb, role: Role): Shade =
    in.note(name, Colors.Kind, Colors.text(default))
    givenShade(in, name, role).getOrElse(Shade.Constant(default))

  def givenShade(in: Properties, name: String, role: Role): Option[Shade] =
    in.note(name, Colors.Kind)
    in.property(name).flatMap: p =>
      p.value match
        case Value.Number(x) => Some(Shade.Constant(Rgb.gray(x.toFloat)))
        case Value.Color(c) =>
          val isReflectance = role == Role.Reflectance
          Some(Shade.Constant(if isReflectance then inRange(c, in, p) else c))
        case Value.Wavelengths(s) => Some(measured(s, role))
        case Value.Flat(x) if role == Role.Emission => Some(measured(flat(x), role))
        case Value.Flat(x) => Some(Shade.Constant(Rgb.gray(x.toFloat)))
        case Value.Nested(_) | Value.Reference(_) =>
          in.objectNamed(name).flatMap(ofPlugin(_, role, in, name))
        case other =>
          session.error(
            Code.ParameterValue,
            p.pos,
            s"`$name` must be a colour or a texture, found ${other.description}"
          )
          None

  /** Colours of 0.6 had no limit; skies check theirs. The roughness `alpha` takes any. */
  private def inRange(c: Rgb, in: Properties, p: Property): Rgb =
    val components = Vector(c.r, c.g, c.b)
    if in.plugin.isOld || in.plugin.kind == "emitter" || p.name.startsWith("alpha") ||
      components.forall(x => x >= 0f && x <= 1f)
    then c
    else
      val consequence =
        if components.exists(_ < 0f) then "negative components are 0" else "it is used"
      session.warn(
        Code.ParameterValue,
        p.pos,
        s"Mitsuba rejects `${p.name}` as an <rgb> outside 0 to 1; $consequence"
      )
      c.atLeast(Rgb.Black)

  private def ofPlugin(p: Plugin, role: Role, in: Properties, name: String): Option[Shade] =
    if p.kind != "texture" && p.kind != "spectrum" then
      session.error(
        Code.ParameterValue,
        p.pos,
        s"`$name` of ${in.plugin.description} must be a colour or a texture"
      )
      None
    else if p.name == "irregular" then
      Some(session.translate(p)(in => measured(irregular(in), role)))
    else if p.name == "regular" then Some(session.translate(p)(in => measured(regular(in), role)))
    else Some(constant(p, role).fold(Shade.Textured(p))(Shade.Constant(_)))

  /** The colour of a spectrum; None for textures. */
  private def constant(p: Plugin, role: Role): Option[Rgb] =
    p.name match
      case "srgb" => Some(session.translate(p)(in => fixed(in, "color", Rgb.gray(0.5f), role)))
      case "uniform" => Some(session.translate(p)(in => Rgb.gray(in.number("value", 1).toFloat)))
      case "d65" =>
        Some(session.translate(p): in =>
          fixed(in, "color", Rgb.White, role) * in.number("scale", 1).toFloat)
      case "blackbody" =>
        Some(session.translate(p): in =>
          in.ignore("wavelength_min", "wavelength_max")
          blackbody(in.number("temperature", 5000).toFloat, in.pos) *
            in.number("scale", 1).toFloat)
      case "rawconstant" => Some(session.translate(p)(raw))
      case "scale" => scaled(p, role)
      case "wireframe" =>
        session.warn(
          Code.Unsupported,
          p.pos,
          s"${p.description} is not supported; using the colour of its interior"
        )
        Some(session.translate(p): in =>
          in.ignore("edge_color", "line_width", "step_width")
          fixed(in, "interior_color", Rgb.gray(0.5f), role))
      case "volume" =>
        val properties = Properties(p, session)
        properties.objectNamed("volume") match
          case Some(v) if v.kind == "volume" && v.name == "constvolume" =>
            Some(everywhere(v, Rgb.gray(0.75f), role))
          case Some(v) if v.kind == "volume" => None
          case _ => Some(session.translate(p)(fixed(_, "volume", Rgb.gray(0.75f), role)))
      case _ => None

  /** A constant times a factor; None around textures. */
  private def scaled(p: Plugin, role: Role): Option[Rgb] =
    val properties = Properties(p, session)
    val inner = properties.nested("texture") ++ properties.nested("spectrum")
    val value = inner.headOption.fold(givenShade(
      properties,
      "value",
      role
    ))(ofPlugin(_, role, properties, "value"))
    value.flatMap(_.constant).map(_ * fixed(properties, "scale", Rgb.White, Role.Unbounded))

  /** Of a constant volume. */
  def everywhere(v: Plugin, default: Rgb, role: Role): Rgb =
    session.translate(v): in =>
      in.ignore("to_world")
      fixed(in, "value", default, role)

  /** A number or three. */
  private def raw(in: Properties): Rgb =
    in.note("value", "float, vector")
    in.property("value").map(_.value) match
      case Some(Value.Triple(x, y, z)) => Rgb(x.toFloat, y.toFloat, z.toFloat)
      case None =>
        val message = s"${in.plugin.description} must have a `value`"
        session.error(Code.MissingParameter, in.pos, message)
        Rgb.White
      case _ => Rgb.gray(in.number("value", 1).toFloat)

  /** A constant colour. */
  def fixed(in: Properties, name: String, default: Rgb, role: Role): Rgb =
    uniform(in, name, default, role).c

  /** A constant colour, with its spectrum. */
  def uniform(in: Properties, name: String, default: Rgb, role: Role): Shade.Constant =
    shade(in, name, default, role) match
      case c: Shade.Constant => c
      case Shade.Textured(t) =>
        session.warn(
          Code.CorrectedValue,
          t.pos,
          s"`$name` of ${in.plugin.description} must be constant here; using the default"
        )
        Shade.Constant(default)

  private def list(in: Properties, name: String): Vector[Double] =
    in.text(name).fold(Vector.empty)(Values.numbers(_, in.posOf(name)))

  private def irregular(in: Properties): Spectrum =
    in.text("filename") match
      case Some(name) => session.values.file(name, in.pos)
      case None =>
        val (lambda, values) = (list(in, "wavelengths"), list(in, "values"))
        if lambda.size != values.size then
          Values.fail(
            Code.SpectrumFile,
            in.pos,
            s"${lambda.size} wavelengths, but ${values.size} values"
          )
        Values.spectrum(lambda.zip(values).flatMap((l, v) => Vector(l, v)), in.pos)

  private def regular(in: Properties): Spectrum =
    val (from, to) = (in.number("wavelength_min", 360), in.number("wavelength_max", 830))
    val values = list(in, "values")
    val step = (to - from) / (values.size - 1).max(1)
    Values.spectrum(
      values.indices.flatMap(i => Vector(from + i * step, values(i))).toVector,
      in.pos
    )

  private def measured(s: Spectrum, role: Role): Shade =
    Shade.Constant(role.color(s), Option.when(role == Role.Emission)(s))

  private def flat(x: Double): Spectrum =
    Spectrum(Array(360f, 830f), Array.fill(2)(x.toFloat), Spectrum.Outside.Zero)

  /** Light with positive channels, too, is rendered. */
  def warnOfNegative(c: Rgb, at: SourcePos): Unit =
    if Math.min(c.r, Math.min(c.g, c.b)) < 0f && c.max <= 0f then
      session.warn(
        Code.Unsupported,
        at,
        "negative emission is not supported"
      )

  /** Light of a constant colour, times a factor: of its spectrum, if it has one. pbrt-v4 scales
    * spectra of light to luminance 1.
    */
  def light(name: String, shade: Shade.Constant, at: SourcePos, factor: Float = 1f): Seq[Param] =
    val c = shade.c * factor
    warnOfNegative(c, at)
    shade.light.filter(_ => c.luminance > 0f).fold(Seq(Textures.rgb(name, c, at))): s =>
      val pairs = s.lambda.zip(s.values).flatMap((nm, x) => Array(nm, x))
      Seq(
        Param.floats(ParamType.Spectrum, name, at, pairs),
        Param.float("scale", at, c.luminance)
      )

  /** In W/(m² sr nm), as Mitsuba's. */
  private def blackbody(kelvin: Float, at: SourcePos): Rgb =
    if !(kelvin > 0) then
      Values.fail(Code.ParameterValue, at, "the temperature of a black body must be positive")
    val relative = Spectrum.blackbody(kelvin)
    // Wien's displacement law, and Planck's at that wavelength
    val peak = 2.8977721e-3 / kelvin
    val (c, h, k) = (299792458.0, 6.62607015e-34, 1.380649e-23)
    val radiance = 2 * h * c * c / Math.pow(peak, 5) / Math.expm1(h * c / (peak * k * kelvin))
    Role.Emission.color(relative) * (radiance * 1e-9).toFloat

private object Colors:
  /** Elements by which colours are given. */
  val Kind = "rgb, spectrum, texture"

  def text(c: Rgb): String =
    if c.r == c.g && c.g == c.b then Properties.text(c.r)
    else Vector(c.r, c.g, c.b).map(x => Properties.text(x)).mkString(", ")
