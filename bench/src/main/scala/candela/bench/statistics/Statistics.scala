package candela.bench.statistics

import candela.measure.Interval

import org.apache.commons.statistics.distribution.{ChiSquaredDistribution, TDistribution}

/** Figures of independent measurements. */
object Statistics:

  /** Mean, by Student's t. Assumes approximate normality, which averages over many pixels have.
    * ("Student", "The probable error of a mean", Biometrika 6, 1908.)
    */
  def mean(values: Vector[Double]): Interval =
    val n = values.size
    require(n > 0, "no measurements")
    val mean = values.sum / n
    if n == 1 then Interval(mean, Double.NaN, Double.NaN)
    else
      val halfWidth = studentLimit(n - 1) * deviation(values) / Math.sqrt(n)
      Interval(mean, mean - halfWidth, mean + halfWidth)

  /** Standard deviation of what the values are drawn from; NaN for a single one. */
  def deviation(values: Vector[Double]): Double =
    val mean = values.sum / values.size
    Math.sqrt(values.map(v => (v - mean) * (v - mean)).sum / (values.size - 1))

  def median(values: Vector[Double]): Double =
    val sorted = values.sorted
    val middle = sorted.size / 2
    if sorted.size % 2 == 1 then sorted(middle) else (sorted(middle - 1) + sorted(middle)) / 2

  /** The t beyond which, on both sides, is a chance of 5 %. */
  def studentLimit(freedom: Double): Double =
    TDistribution.of(freedom).inverseSurvivalProbability(0.025)

  /** Upper end of the one-sided 95 % interval of a Poisson number, of which `count` were seen. */
  def countLimit(count: Long): Double =
    ChiSquaredDistribution.of(2.0 * (count + 1)).inverseSurvivalProbability(0.05) / 2
