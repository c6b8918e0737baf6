package candela.color

import candela.math.*

/** Piecewise-linear function of wavelength.
  *
  * @param lambda wavelengths in nm, ascending
  * @param outside extrapolation past the first and last wavelength: their values, or 0
  */
final class Spectrum(
    val lambda: Array[Float],
    val values: Array[Float],
    outside: Spectrum.Outside = Spectrum.Outside.Clamped
):
  def apply(nm: Float): Float =
    val n = lambda.length
    val beyond = outside == Spectrum.Outside.Zero
    if n == 0 then 0f
    else if nm <= lambda(0) then (if beyond && nm < lambda(0) then 0f else values(0))
    else if nm >= lambda(n - 1) then (if beyond && nm > lambda(n - 1) then 0f else values(n - 1))
    else
      val position = java.util.Arrays.binarySearch(lambda, nm)
      val i = if position >= 0 then position else -position - 2
      lerp((nm - lambda(i)) / (lambda(i + 1) - lambda(i)), values(i), values(i + 1))

  /** Whether its values at multiples of 5 nm determine it. */
  def isCoarse: Boolean = outside == Spectrum.Outside.Clamped && lambda.forall(_ % 5f == 0f)

  def *(s: Float): Spectrum = Spectrum(lambda, values.map(_ * s), outside)

object Spectrum:
  enum Outside:
    case Clamped, Zero

  /** Spectral radiance of a black body of `kelvin`, scaled to a maximum of 1 (Planck's law; the
    * maximum by Wien's displacement law).
    */
  def blackbody(kelvin: Float): Spectrum = blackbody(kelvin, 2.8977721e6f / kelvin)

  /** As above, scaled to 1 at the wavelength `unitAt`, in nm. */
  def blackbody(kelvin: Float, unitAt: Float): Spectrum =
    val unit = planck(unitAt * 1e-9, kelvin)
    val lambda = Array.tabulate(95)(i => 360f + 5f * i)
    Spectrum(lambda, lambda.map(l => (planck(l * 1e-9, kelvin) / unit).toFloat))

  /** W·m⁻²·sr⁻¹·m⁻¹ at a wavelength in metres; constants of CODATA 2018 (exact). */
  private def planck(meters: Double, kelvin: Double): Double =
    val c = 299792458.0
    val h = 6.62607015e-34
    val kb = 1.380649e-23
    2 * h * c * c / (Math.pow(meters, 5) * Math.expm1(h * c / (meters * kb * kelvin)))

/** Daylight (sun and sky), by correlated colour temperature. */
object Daylight:

  /** Temperature that pbrt-v4 uses for daylight of nominally `kelvin`: nominal values predate the
    * 1968 revision of Planck's constant.
    */
  private[color] def correlated(kelvin: Float): Double = kelvin * 1.4388 / 1.4380

  /** Relative spectral power; below 4000 K, where daylight is undefined, of a black body.
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
