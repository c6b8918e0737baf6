package candela.build.materials

import candela.build.recipe.*
import candela.color.{Rgb, Upsampling}

/** Indices of refraction that may come as spectra. */
private[build] object Indices:
  val glass: SpectralValue = SpectralValue.Color(Rgb.gray(1.5f))

  def spectrum(v: SpectralValue): Float => Float = v match
    case SpectralValue.Wavelengths(s) => s(_)
    case SpectralValue.Color(c) => Upsampling.unbounded(c)

  /** By wavelength, of a colour that is reflected; a grey is the same everywhere. */
  def reflectance(c: Rgb): Float => Float =
    val isGrey = (c - Rgb.gray(c.g)).map(Math.abs(_)).max <= 1e-5f * c.g
    if isGrey then _ => c.g else Upsampling.spectrum(c)

  /** The index by wavelength, if it depends on that, and [[Usual]]. */
  def dispersive(v: SpectralValue): Option[(Float => Float, Float)] = v match
    case SpectralValue.Wavelengths(s) if s.values.distinct.length > 1 =>
      Some((nm => positive(s(nm)), positive(s(Usual))))
    case _ => None

  private def positive(index: Float): Float = if index > 0f then index else 1f

  /** The sodium line, by which glass is named, in nm. */
  private inline val Usual = 589.3f

  /** One index for all wavelengths: that at the sodium line, where dispersion is not modelled. 0
    * stands for 1, as in pbrt-v4.
    */
  def one(v: SpectralValue)(using Site): Float =
    val index = named(v)
    if index == 0f then 1f else index

  private def named(v: SpectralValue)(using site: Site): Float = v match
    case SpectralValue.Color(c) => c.average
    case SpectralValue.Wavelengths(s) =>
      if s.values.distinct.length > 1 then
        val name = site.declaration.name
        site.warn(
          s"dispersion of \"$name\" is not supported: the index of refraction at 589 nm is used"
        )
      s(Usual)
