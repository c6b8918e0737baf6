package candela.convert

import candela.base.Decimal
import candela.color.{Colorimetry, NamedSpectra, Rgb, Spectrum}
import candela.color.Colorimetry.White
import candela.scenefile.*

/** Converts parameter values between dialects. */
final class Values(from: Dialect, to: Dialect, warn: (Param, String) => Unit):

  /** The value in the target dialect's form; None if it has none.
    *
    * @param name parameter name in the target dialect
    */
  def adapt(p: Param, name: String, d: Declaration): Option[Param] =
    val isUnbounded = Values.Unbounded(name)
    p.paramType match
      case ParamType.Xyz => colored(p, d, isUnbounded)
      case ParamType.Blackbody => colored(p, d, isUnbounded)
      case ParamType.Float if Values.Spectral(name) && to == Dialect.V4 =>
        if isUnbounded then Some(Values.constant(p)) else colored(p, d, isUnbounded)
      case ParamType.Rgb => colored(p, d, isUnbounded)
      case ParamType.Spectrum if isUnbounded && !Values.Coefficients(name) => indices(p, d)
      case ParamType.Spectrum => colored(p, d, isUnbounded)
      case _ => Some(p)

  /** As RGB; v4 requires reflectances in [0, 1]. */
  private def colored(p: Param, d: Declaration, isUnbounded: Boolean): Option[Param] =
    color(p, d).map: c =>
      val upperBound = if isUnbounded || to != Dialect.V4 then Float.PositiveInfinity else 1f
      val bounded = c.map(x => Math.max(0f, Math.min(x, upperBound)))
      if bounded != c && p.paramType == ParamType.Rgb then
        warn(p, s"`${p.name}` must be in [0, 1] in v4; clamping")
      Values.rgb(p, bounded)

  /** Spectral indices of refraction and similar: v2 and v3 extrapolate past the first and last
    * wavelength, v4 does not; only v4 has named spectra.
    */
  private def indices(p: Param, d: Declaration): Option[Param] =
    if to == Dialect.V4 && p.strings.nonEmpty then Some(p)
    else if to != Dialect.V4 && p.strings.nonEmpty && NamedSpectra(p.strings.head).isEmpty then
      Some(p)
    else
      spectrum(p, d).map: s =>
        val pairs = s.lambda.zip(s.values)
        val ends = Vector(360f, 830f).filter(x => x < s.lambda.head || x > s.lambda.last)
        val extended = if to == Dialect.V4 then pairs ++ ends.map(x => (x, s(x))) else pairs
        Values.pairs(p, extended.sortBy(_._1).toIndexedSeq)

  /** The colour of a parameter in the source dialect. */
  def color(p: Param, d: Declaration): Option[Rgb] = p.paramType match
    case ParamType.Rgb if p.floats.length == 3 =>
      Some(Rgb(p.floats(0), p.floats(1), p.floats(2)))
    case ParamType.Float if p.floats.length == 1 => Some(Rgb.gray(p.floats(0)))
    case ParamType.Xyz if p.floats.length == 3 =>
      Some(Colorimetry.fromXyz(p.floats(0).toDouble, p.floats(1).toDouble, p.floats(2).toDouble))
    case ParamType.Blackbody =>
      val scale = if p.floats.length > 1 && from != Dialect.V4 then p.floats(1) else 1f
      val body =
        if from == Dialect.V2 then Spectrum.blackbody(p.floats(0), unitAt = 555f)
        else Spectrum.blackbody(p.floats(0))
      Some(Colorimetry.rgb(body, white) * scale)
    case ParamType.Spectrum => spectrum(p, d).map(s => Colorimetry.rgb(s, white))
    case _ => None

  private def white: White = if from == Dialect.V4 then White.D65 else White.EqualEnergy

  /** A function of wavelength: pairs, a named spectrum, or a file of pairs. */
  def spectrum(p: Param, d: Declaration): Option[Spectrum] =
    val outside = if from == Dialect.V4 then Spectrum.Outside.Zero else Spectrum.Outside.Clamped
    def fromPairs(numbers: Array[Float]) =
      val sorted = numbers.grouped(2).filter(_.length == 2).toArray.sortBy(_(0))
      Option.when(sorted.nonEmpty)(Spectrum(sorted.map(_(0)), sorted.map(_(1)), outside))
    p.strings.headOption match
      case None => fromPairs(p.floats)
      case Some(name) =>
        NamedSpectra.difference(name).foreach(warn(p, _))
        NamedSpectra(name).orElse:
          val read = numbersOf(p, d).flatMap(fromPairs)
          if read.isEmpty then warn(p, s"no such spectrum: `$name`; ignoring `${p.name}`")
          read

  private def numbersOf(p: Param, d: Declaration): Option[Array[Float]] =
    d.folder.locate(p.strings.head, Some(p.valuesAt)).map: file =>
      val words = file.lines().flatMap(_.takeWhile(_ != '#').trim.split("[\\s,]+"))
      words.flatMap(Decimal.float).toArray

object Values:
  /** Parameters with values outside [0, 1], though colours. */
  private[convert] val Unbounded =
    Set("eta", "k", "sigma_a", "sigma_s", "mfp", "Le", "conductor.eta", "conductor.k",
      "interface.eta")

  /** Of media. Where a renderer multiplies colours, a flat spectrum is grey in v4 only. */
  private val Coefficients = Set("sigma_a", "sigma_s", "mfp")

  /** Parameters for which v4 requires a colour or a spectrum, not a number. */
  private val Spectral =
    Set("reflectance", "transmittance", "k", "sigma_a", "sigma_s", "mfp", "albedo")

  def isGray(c: Rgb): Boolean = c.r == c.g && c.g == c.b

  def renamed(p: Param, name: String): Param =
    if p.name == name then p else p.renamed(name, p.paramType)

  def rgb(p: Param, c: Rgb): Param =
    Param(ParamType.Rgb, p.name, p.pos, p.valuesAt, floats = Array(c.r, c.g, c.b))

  def pairs(p: Param, values: IndexedSeq[(Float, Float)]): Param =
    val floats = values.flatMap((x, y) => Vector(x, y)).toArray
    Param(ParamType.Spectrum, p.name, p.pos, p.valuesAt, floats = floats)

  /** A constant spectrum. */
  def constant(p: Param): Param = pairs(p, Vector((360f, p.floats(0)), (830f, p.floats(0))))

  def typed(p: Param, t: ParamType): Param =
    p.renamed(p.name, t)
