package candela.color

/** Indices of refraction that vary with the wavelength, by the first two terms of Cauchy's
  * equation.
  *
  * Source: KHR_materials_dispersion.
  */
object Cauchy:
  /** Wavelengths in nm between which the index is interpolated. */
  private val Range = 360 to 830 by 10

  /** @param eta        index at 587.56 nm
    * @param dispersion 20 over the Abbe number; 0: none
    */
  def apply(eta: Float, dispersion: Float): Spectrum =
    if dispersion == 0f then Spectrum(Array(550f), Array(eta))
    else
      def at(nm: Double) =
        Math.max(eta + (eta - 1) * dispersion / 20 * (523655 / (nm * nm) - 1.5168), 1.0)
      Spectrum(Range.map(_.toFloat).toArray, Range.map(at(_).toFloat).toArray)
