package candela.measure

/** Student's t distribution. */
object StudentT:

  /** The chance of a t beyond ±`t`.
    *
    * @param freedom degrees of freedom, not necessarily whole; infinite: the normal distribution
    */
  def twoSided(t: Double, freedom: Double): Double =
    if t.isNaN then 1.0
    else if t.isInfinite then 0.0
    else
      // Far beyond where t differs from the normal distribution
      val n = Math.min(freedom, 1e9)
      incompleteBeta(n / 2, 0.5, n / (n + t * t))

  /** The regularised incomplete beta function I_x(a, b), by its continued fraction, with a relative
    * error below 10⁻¹⁰ for the arguments of [[twoSided]].
    *
    * Sources: Abramowitz and Stegun, 26.5.8; Lentz, "Generating Bessel functions in Mie scattering
    * calculations using continued fractions", Applied Optics 15, 1976.
    */
  private[measure] def incompleteBeta(a: Double, b: Double, x: Double): Double =
    if x <= 0 then 0.0
    else if x >= 1 then 1.0
    else
      val front = Math.exp(
        logGamma(a + b) - logGamma(a) - logGamma(b) + a * Math.log(x) + b * Math.log1p(-x)
      )
      // The fraction converges fast on this side of the mean
      if x < (a + 1) / (a + b + 2) then front * fraction(a, b, x) / a
      else 1 - front * fraction(b, a, 1 - x) / b

  private def fraction(a: Double, b: Double, x: Double): Double =
    def away(v: Double) = if Math.abs(v) < Tiny then Tiny else v
    var c = 1.0
    var d = 1 / away(1 - (a + b) * x / (a + 1))
    var value = d
    var m = 1
    var isFar = true
    while isFar && m < MostTerms do
      val even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
      d = 1 / away(1 + even * d)
      c = away(1 + even / c)
      value *= d * c
      val odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
      d = 1 / away(1 + odd * d)
      c = away(1 + odd / c)
      value *= d * c
      isFar = Math.abs(d * c - 1) > 1e-14
      m += 1
    value

  private val Tiny = 1e-300
  private val MostTerms = 100_000

  /** By Stirling's series (Abramowitz and Stegun, 6.1.41), from 10 on; below, by recurrence. */
  private def logGamma(x: Double): Double =
    var shift = 0.0
    var z = x
    while z < 10 do
      shift -= Math.log(z)
      z += 1
    val r = 1 / z
    val series = r * (1.0 / 12 - r * r * (1.0 / 360 - r * r * (1.0 / 1260 - r * r / 1680)))
    shift + (z - 0.5) * Math.log(z) - z + 0.5 * Math.log(2 * Math.PI) + series
