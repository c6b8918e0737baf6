package candela.build

import candela.color.{Rgb, Upsampling}

/** Indices of refraction that may come as spectra. */
private[build] object Indices:
  val glass: SpectralValue = SpectralValue.Color(Rgb.gray(1.5f))

  def spectrum(v: SpectralValue): Float => Float = v match
    case SpectralValue.Wavelengths(s) => s(_)
    case SpectralValue.Color(c) => Upsampling.unbounded(c)

  /** The index at the sodium line (589.3 nm), by which glass is named; dispersion is not
    * modelled.
    */
  def one(v: SpectralValue)(using site: Site): Float = v match
    case SpectralValue.Color(c) => c.average
    case SpectralValue.Wavelengths(s) =>
      if s.values.distinct.length > 1 then
        site.warn("dispersion is not supported yet: the index of refraction at 589 nm is used")
      s(589.3f)
