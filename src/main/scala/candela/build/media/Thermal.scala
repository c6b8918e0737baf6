package candela.build.media

import candela.build.recipe.*
import candela.color.{Colorimetry, Rgb, Spectrum}
import candela.color.Colorimetry.White
import candela.media.ThermalColors

/** How pbrt-v4's media glow by their temperature. */
private[build] object Thermal:

  /** ∫ ȳ(λ) dλ in nm, of the CIE 1931 observer: what light is brighter by that pbrt-v4 does not
    * divide by it.
    */
  val LuminousIntegral = 106.856895f

  /** Colours of black bodies, in a basis, whose spectra have a maximum of 1. */
  def colors(hottest: Float)(using site: Site): ThermalColors =
    ThermalColors(
      hottest,
      kelvin =>
        val c = Colorimetry.rgb(Spectrum.blackbody(kelvin)(_), White.EqualEnergy)
        site.resources.basis.fromSrgb(c * LuminousIntegral): Rgb
    )
