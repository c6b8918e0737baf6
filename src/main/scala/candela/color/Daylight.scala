package candela.color

/** The light of the sun and the sky together, by its colour temperature. */
object Daylight:

  /** The temperature that pbrt-v4 takes for daylight that is named by `kelvin`: such names are by
    * Planck's constant of before 1968.
    */
  private[color] def correlated(kelvin: Float): Double = kelvin * 1.4388 / 1.4380

  /** Relative spectral power; below 4000 K, where there is no daylight, of a black body.
    *
    * Source: CIE 15:2004, §3.1.
    */
  def spectrum(kelvin: Float): Spectrum =
    val temperature = correlated(kelvin)
    if temperature < 4000 then Spectrum.blackbody(temperature.toFloat)
    else
      val (x, y) = WhiteBalance.chromaticity(temperature)
      val m = 0.0241 + 0.2562 * x - 0.7341 * y
      val m1 = (-1.3515 - 1.7703 * x + 5.9114 * y) / m
      val m2 = (0.0300 - 31.4424 * x + 30.0717 * y) / m
      Spectrum(
        components.map(_(0)),
        components.map(row => (row(1) + m1 * row(2) + m2 * row(3)).toFloat)
      )

  private lazy val components = Colorimetry.table("daylight")
