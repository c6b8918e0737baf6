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
      val half = studentT(n - 1) * deviation(values) / Math.sqrt(n)
      Interval(mean, mean - half, mean + half)

  /** Standard deviation of what the values are drawn from; NaN for a single one. */
  def deviation(values: Vector[Double]): Double =
    val mean = values.sum / values.size
    Math.sqrt(values.map(v => (v - mean) * (v - mean)).sum / (values.size - 1))

  def median(values: Vector[Double]): Double =
    val sorted = values.sorted
    val middle = sorted.size / 2
    if sorted.size % 2 == 1 then sorted(middle) else (sorted(middle - 1) + sorted(middle)) / 2

  /** Two-sided 95 % quantile of Student's t distribution. From 30 degrees of freedom on, the normal
    * quantile with two terms of its expansion (Abramowitz and Stegun, 26.7.5), with an error below
    * 0.0001; between whole degrees, linear in their reciprocal.
    */
  def studentT(degrees: Double): Double =
    require(degrees >= 1, s"$degrees degrees of freedom")
    if degrees < Table.size then
      val whole = degrees.toInt
      val part = (1.0 / whole - 1 / degrees) / (1.0 / whole - 1.0 / (whole + 1))
      Table(whole - 1) + part * (Table(whole) - Table(whole - 1))
    else
      val z = 1.959964
      val (cube, fifth) = (z * z * z, z * z * z * z * z)
      z + (cube + z) / (4 * degrees) +
        (5 * fifth + 16 * cube + 3 * z) / (96 * degrees * degrees)

  private val Table = Vector(
    12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622, 2.2281, //
    2.2010, 2.1788, 2.1604, 2.1448, 2.1314, 2.1199, 2.1098, 2.1009, 2.0930, 2.0860, //
    2.0796, 2.0739, 2.0687, 2.0639, 2.0595, 2.0555, 2.0518, 2.0484, 2.0452, 2.0423
  )
