package candela.build.recipe

import candela.base.Decimal
import candela.diagnostics.{Code, Suggest}
import candela.io.{InputFile, IoReason}
import java.io.IOException

import candela.color.{ColorBasis, ColorSpace, Colorimetry, NamedSpectra, Rgb, Spectrum, Upsampling}
import candela.color.Colorimetry.White
import candela.scenefile.{Dialect, Param, ParamType}
import candela.textures.{ConstantRgb, RgbTexture}

/** Quantity that a spectrum describes, which determines its conversion to a colour. */
enum SpectrumRole:
  /** `Unbounded`: not negative, such as an index of refraction or a coefficient. */
  case Reflectance, Unbounded, Emission

/** Value of a spectrum parameter: a linear colour or a function of wavelength. */
enum SpectralValue:
  case Color(rgb: Rgb, space: ColorSpace = ColorSpace.Srgb)
  case Wavelengths(spectrum: Spectrum)

/** Reads spectrum parameters in all their notations. */
object Spectra:

  /** Reads a colour in the scene's basis. Returns None after reporting a problem. */
  def rgb(p: Param, role: SpectrumRole, site: Site): Option[Rgb] =
    p.paramType match
      case ParamType.Blackbody =>
        blackbody(p, site).map((body, scale) => inBasis(body, role, site) * scale)
      case ParamType.Spectrum if p.strings.nonEmpty =>
        val spectrum = named(p, site, StandIns.Magentas).map(SpectralValue.Wavelengths(_))
        Some(inBasis(spectrum.getOrElse(SpectralValue.Color(StandIns.Magenta)), role, site))
      case _ =>
        value(p, site).map(inBasis(_, role, site))

  /** The value in the scene's basis. */
  def inBasis(value: SpectralValue, role: SpectrumRole, site: Site): Rgb =
    val basis = site.resources.basis
    if basis.isSpectral then atWavelengths(value, role, site)
    else
      val components = inThree(value, role, site)
      site.resources.counting.foreach(_.add(value, role, components))
      components

  private def inThree(value: SpectralValue, role: SpectrumRole, site: Site): Rgb =
    val basis = site.resources.basis
    val color = value match
      case SpectralValue.Color(c, space) => inSrgb(c, space, role, basis)
      case SpectralValue.Wavelengths(s) => toRgb(s, role, site.dialect)
    basis.fromSrgb(color)

  private def atWavelengths(value: SpectralValue, role: SpectrumRole, site: Site): Rgb =
    val basis = site.resources.basis
    (value, role) match
      case (SpectralValue.Color(c, space), SpectrumRole.Emission) if space.isSrgb =>
        basis.ofLight(c)
      case (SpectralValue.Color(c, space), SpectrumRole.Emission) =>
        val filter = Upsampling.unbounded(c, space)
        basis.ofLight(nm => filter(nm) * space.illuminant(nm), space.emission(c))
      case (SpectralValue.Color(c, space), SpectrumRole.Reflectance) if space.isSrgb =>
        basis.fromSrgb(c)
      case (SpectralValue.Color(c, space), SpectrumRole.Reflectance) if c.max <= 1f =>
        basis.ofReflectance(Upsampling.spectrum(c, space))
      case (SpectralValue.Color(c, space), _) if space.isSrgb => basis.unbounded(c)
      case (SpectralValue.Color(c, space), _) => basis.ofReflectance(Upsampling.unbounded(c, space))
      case (SpectralValue.Wavelengths(s), SpectrumRole.Emission) =>
        basis.ofLight(s(_), toRgb(s, role, site.dialect))
      case (SpectralValue.Wavelengths(s), _) => basis.ofReflectance(s(_))

  /** Light of white, 1 in three numbers: of images, which have colours of their own. */
  def white(using site: Site): Rgb =
    val basis = site.resources.basis
    if basis.isSpectral then basis.ofLight(Rgb.White) else Rgb.White

  /** A default, given as a colour of the statement's space. Three-number bases take reflectances,
    * and light in sRGB, as they are.
    */
  def default(c: Rgb, role: SpectrumRole, site: Site): Rgb =
    val isLight = role == SpectrumRole.Emission
    val value = SpectralValue.Color(c, site.colorSpace)
    if site.resources.basis.isSpectral || (isLight && !site.colorSpace.isSrgb) then
      inBasis(value, role, site)
    else
      // Light shows the colours of all else
      if isLight then site.resources.counting.foreach(_.add(value, role, c))
      c

  /** A colour of any space in linear sRGB. Three components can't be negative reflectances. */
  private def inSrgb(c: Rgb, space: ColorSpace, role: SpectrumRole, basis: ColorBasis): Rgb =
    if space.isSrgb then c
    else
      role match
        case SpectrumRole.Emission => space.emission(c)
        case SpectrumRole.Reflectance => nonNegative(space.reflectance(c), basis)
        case SpectrumRole.Unbounded => nonNegative(space.unbounded(c), basis)

  private def nonNegative(c: Rgb, basis: ColorBasis): Rgb =
    basis.toSrgb(basis.fromSrgb(c).map(Math.max(_, 0f)))

  /** One of many colours in the colour space of the statement, in the scene's basis: the spectra of
    * reflectances are not fitted.
    */
  def ofMany(c: Rgb, role: SpectrumRole, site: Site): Rgb =
    val (space, basis) = (site.colorSpace, site.resources.basis)
    if role == SpectrumRole.Emission then basis.ofLight(space.light(c))
    else if space.isSrgb then basis.unbounded(c)
    else basis.unbounded(space.toSrgbAdapted * c).map(Math.max(_, 0f))

  /** pbrt-v2 and v3 weight all wavelengths equally; v4 views reflectances under D65 and normalises
    * emission to luminance 1.
    */
  def toRgb(s: Spectrum, role: SpectrumRole, dialect: Dialect): Rgb =
    if dialect != Dialect.V4 then Colorimetry.rgb(s, White.EqualEnergy)
    else if role == SpectrumRole.Emission then Colorimetry.unitLuminance(s)
    else Colorimetry.rgb(s, White.D65)

  /** Colour under D65 of a reflectance given by cosine and wavelength. */
  def underWhite(reflected: Float => Float => Float)(using site: Site): Float => Rgb =
    cosTheta =>
      site.resources.basis.ofReflectance(reflected(cosTheta))

  def value(p: Param, site: Site): Option[SpectralValue] =
    p.paramType match
      case ParamType.Rgb if p.floats.length == 3 =>
        Some(
          SpectralValue.Color(Rgb(p.floats(0), p.floats(1), p.floats(2)), site.colorSpaceOf(p))
        )
      case ParamType.Xyz if p.floats.length == 3 =>
        val Array(x, y, z) = p.floats.map(_.toDouble): @unchecked
        Some(SpectralValue.Color(Colorimetry.fromXyz(x, y, z)))
      case ParamType.Float if p.floats.length == 1 =>
        // Older scenes write "float eta" for a spectrum: a constant
        Some(SpectralValue.Color(Rgb.gray(p.floats(0))))
      case ParamType.Spectrum if p.strings.nonEmpty =>
        named(p, site, StandIns.Default).map(SpectralValue.Wavelengths(_))
      case ParamType.Spectrum if p.floats.isEmpty && untilV3(site.dialect) =>
        // pbrt-v2 and v3 make a spectrum of no samples
        Some(SpectralValue.Color(Rgb.Black))
      case ParamType.Spectrum if p.floats.length >= 2 && p.floats.length % 2 == 0 =>
        pairs(p.floats, p, site).map(SpectralValue.Wavelengths(_))
      case other =>
        val count = Math.max(p.floats.length, p.strings.size)
        site.unread(
          Code.ParameterType,
          p,
          s"`${p.name}` must be a colour or a spectrum, found $count of type ${other.spelling}",
          Some("write e.g. \"rgb " + p.name + "\" [ 0.5 0.5 0.5 ]")
        )
        None

  /** The spectrum and its scale. */
  private def blackbody(p: Param, site: Site): Option[(SpectralValue, Float)] =
    val scale = if p.floats.length >= 2 && site.dialect != Dialect.V4 then p.floats(1) else 1f
    for case Array(kelvin) <- Kelvins.held(p.truncated(1), "K", site).map(_.floats) yield
      // pbrt-v2 normalises the spectrum at 555 nm, v3 and v4 at its maximum
      val body =
        if site.dialect == Dialect.V2 then Spectrum.blackbody(kelvin, unitAt = 555f)
        else Spectrum.blackbody(kelvin)
      (SpectralValue.Wavelengths(body), scale)

  private val Kelvins = Range.above(0f)

  private def pairs(numbers: Array[Float], p: Param, site: Site): Option[Spectrum] =
    val sorted = numbers.grouped(2).map(a => (a(0), a(1))).toArray.sortBy(_._1)
    if sorted.map(_._1).distinct.length < sorted.length then
      site.problems.error(
        Code.ParameterValue,
        p.valuesAt,
        s"`${p.name}` must not repeat a wavelength"
      )
      None
    else
      val isAscending = sorted.indices.forall(i => sorted(i)._1 == numbers(2 * i))
      if site.dialect == Dialect.V4 && !isAscending then
        site.problems.warn(
          Code.ParameterValue,
          p.valuesAt,
          s"the wavelengths of `${p.name}` must ascend in pbrt-v4; sorting them"
        )
      val outside =
        if site.dialect == Dialect.V4 then Spectrum.Outside.Zero else Spectrum.Outside.Clamped
      Some(Spectrum(sorted.map(_._1), sorted.map(_._2), outside))

  private def named(p: Param, site: Site, standIn: String): Option[Spectrum] =
    val name = p.strings.head
    for message <- NamedSpectra.difference(name) do
      site.problems.warn(Code.UnlikePbrt, p.valuesAt, message)
    NamedSpectra(name).orElse {
      val folder = site.declaration.folder
      folder.locate(name, Some(p.valuesAt)) match
        case None =>
          val suggestion = Suggest.nearest(name, NamedSpectra.names).map(n => s"did you mean `$n`?")
          val nothing = s"`$name` is neither a named spectrum nor a file"
          val (message, help) = folder.absence(name, Some(p.valuesAt), nothing)
          val advice = suggestion.orElse(help).orElse(Some(s"known: ${NamedSpectra.inWords}"))
          site.problems.missing(Code.SpectrumFile, p.valuesAt, message, standIn, advice)
          None
        case Some(file) =>
          numbers(file, name) match
            case Right(found) => pairs(found, p, site)
            case Left(why) =>
              site.problems.missing(Code.SpectrumFile, p.valuesAt, why, standIn)
              None
    }

  /** Pairs of wavelength and value, or why there are none. */
  private def numbers(file: InputFile, name: String): Either[String, Array[Float]] =
    try
      val words = file.words()
      val values = words.flatMap(Decimal.float).toArray
      if values.length == words.length && values.length % 2 == 0 then Right(values)
      else Left(s"spectrum file `$name` must contain pairs of wavelength and value")
    catch case e: IOException => Left(s"can't read the spectrum file `$name`: ${IoReason(e)}")

/** Value of a parameter: a uniform spectrum or a colour texture. */
enum SpectrumSource:
  case Uniform(value: SpectralValue)

  /** A texture in the scene's basis. */
  case Varying(texture: RgbTexture)

object SpectrumSource:
  /** Returns a texture; `color` converts a uniform value to the basis. */
  def textured(source: SpectrumSource)(color: SpectralValue => candela.color.Rgb): RgbTexture =
    source match
      case Uniform(value) => ConstantRgb(color(value))
      case Varying(texture) => texture

/** Declares parameters that keep their wavelengths unless textured. */
trait SpectrumFields extends Fields:

  protected final def spectrumTexture(
      name: String,
      doc: String,
      in: Set[Dialect] = every,
      shown: String
  )(default: Dialect ?=> SpectralValue): Field[SpectrumSource] =
    val field = Field[SpectrumSource](
      name,
      "spectrum texture",
      doc,
      in,
      "",
      _ => Range.Any,
      d => SpectrumSource.Uniform(default(using d)),
      _ => shown,
      (p, site) =>
        if p.paramType == ParamType.Texture then
          site.resources.rgbTexture(p, site.problems).map: texture =>
            texture.constant match
              case Some(c) if !site.resources.basis.isSpectral =>
                SpectrumSource.Uniform(SpectralValue.Color(site.resources.basis.toSrgb(c)))
              case _ => SpectrumSource.Varying(texture)
        else Spectra.value(p, site).map(SpectrumSource.Uniform(_)),
      (source, _) => source
    )
    register(field)
