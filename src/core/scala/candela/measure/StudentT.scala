package candela.measure

import org.apache.commons.numbers.gamma.RegularizedBeta

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
      val square = t * t
      // The smaller argument is the one without rounding errors
      if square > n then RegularizedBeta.value(n / (n + square), n / 2, 0.5)
      else RegularizedBeta.complement(square / (n + square), 0.5, n / 2)

  /** The t beyond which, on both sides, is a chance of 5 %, by bisection. */
  def limit(freedom: Double): Double =
    require(freedom >= 1, s"$freedom degrees of freedom")
    // Of the normal distribution, and of one degree of freedom
    var (low, high) = (1.95, 12.71)
    while high - low > 1e-9 do
      val middle = (low + high) / 2
      if twoSided(middle, freedom) > 0.05 then low = middle else high = middle
    low
