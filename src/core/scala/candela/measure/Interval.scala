package candela.measure

/** An estimate with its 95 % confidence interval; for a single measurement, the estimate alone
  * (`low` = `high` = NaN). An interval without an upper limit has an infinite one, and one without
  * a lower limit begins at 0.
  */
final case class Interval(estimate: Double, low: Double, high: Double):
  def isKnown: Boolean = !low.isNaN && !high.isNaN

  /** Does it have an upper limit? */
  def isBounded: Boolean = isKnown && !high.isInfinite

  /** Of the reciprocal, of a positive figure. */
  def inverse: Interval = Interval(1 / estimate, 1 / high, 1 / low)

  def *(factor: Double): Interval = Interval(estimate * factor, low * factor, high * factor)

object Interval:

  /** Mean of independent measurements, by Student's t. Assumes approximate normality, which
    * averages over many pixels have. ("Student", "The probable error of a mean", Biometrika 6,
    * 1908.)
    */
  def ofMean(values: Vector[Double]): Interval =
    val n = values.size
    require(n > 0, "no measurements")
    val mean = values.sum / n
    if n == 1 then Interval(mean, Double.NaN, Double.NaN)
    else
      val half = StudentT.limit(n - 1) * deviation(values) / Math.sqrt(n)
      Interval(mean, mean - half, mean + half)

  /** Standard deviation of what the values are drawn from; NaN for a single one. */
  def deviation(values: Vector[Double]): Double =
    val mean = values.sum / values.size
    Math.sqrt(values.map(v => (v - mean) * (v - mean)).sum / (values.size - 1))

  def median(values: Vector[Double]): Double =
    val sorted = values.sorted
    val middle = sorted.size / 2
    if sorted.size % 2 == 1 then sorted(middle) else (sorted(middle - 1) + sorted(middle)) / 2
