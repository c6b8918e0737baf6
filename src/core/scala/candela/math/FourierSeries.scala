package candela.math

/** Even Fourier series: Σ a(k)·cos(kφ). The coefficients are in an array from an offset on. */
object FourierSeries:

  /** The sum of `count` terms. Source of the recurrence: PBRT 3rd ed., §8.6.1. */
  def value(a: Array[Float], from: Int, count: Int, cosPhi: Float): Float =
    val twice = 2.0 * cosPhi
    var previous = cosPhi.toDouble // cos((k − 1)φ), of k = 0
    var current = 1.0
    var sum = 0.0
    var k = 0
    while k < count do
      sum += a(from + k) * current
      val next = twice * current - previous
      previous = current
      current = next
      k += 1
    sum.toFloat

  /** Samples φ in [0, 2π] with a pdf proportional to the series, if it is nowhere negative.
    *
    * @param a coefficients, the first of them positive
    */
  def sample(a: Array[Float], count: Int, u: Float): Float =
    // The series is symmetric about π
    val folded = if u < 0.5f then 2.0 * u else 2.0 - 2.0 * u
    val target = folded * a(0) * Math.PI
    var low = 0.0
    var high = Math.PI
    var phi = folded * Math.PI
    var residual = Double.PositiveInfinity
    while Math.abs(residual) > Exact && high - low > Exact do
      if !(phi >= low && phi <= high) then phi = 0.5 * (low + high)
      // The integral from 0, and the value
      val twice = 2 * Math.cos(phi)
      var sinBefore = 0.0
      var sin = Math.sin(phi)
      var cosBefore = 1.0
      var cos = Math.cos(phi)
      var integral = a(0) * phi
      var density = a(0).toDouble
      var k = 1
      while k < count do
        integral += a(k) * sin / k
        density += a(k) * cos
        val sinNext = twice * sin - sinBefore
        val cosNext = twice * cos - cosBefore
        sinBefore = sin
        sin = sinNext
        cosBefore = cos
        cos = cosNext
        k += 1
      residual = (integral - target) / a(0)
      if residual < 0 then low = phi else high = phi
      if Math.abs(residual) > Exact then phi -= residual * a(0) / density
    (if u < 0.5f then phi else 2 * Math.PI - phi).toFloat

  /** Tolerance of angles, below the resolution of Float. */
  private inline val Exact = 1e-9
