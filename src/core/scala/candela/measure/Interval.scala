package candela.measure

/** An estimate with its 95 % confidence interval; for a single measurement, the estimate alone
  * (`low` = `high` = NaN).
  */
final case class Interval(estimate: Double, low: Double, high: Double):
  def isKnown: Boolean = !low.isNaN && !high.isNaN

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
      val variance = values.map(v => (v - mean) * (v - mean)).sum / (n - 1)
      val half = studentT(n - 1) * Math.sqrt(variance / n)
      Interval(mean, mean - half, mean + half)

  /** Geometric mean, for ratios and products, whose spread is multiplicative. */
  def ofGeometricMean(values: Vector[Double]): Interval =
    val logs = ofMean(values.map(Math.log))
    Interval(Math.exp(logs.estimate), Math.exp(logs.low), Math.exp(logs.high))

  def median(values: Vector[Double]): Double =
    val sorted = values.sorted
    val middle = sorted.size / 2
    if sorted.size % 2 == 1 then sorted(middle) else (sorted(middle - 1) + sorted(middle)) / 2

  /** Two-sided 95 % quantile of Student's t distribution. From 31 degrees of freedom on, the normal
    * quantile with two terms of its expansion (Abramowitz and Stegun, 26.7.5), with an error below
    * 0.0001.
    */
  def studentT(degrees: Int): Double =
    require(degrees >= 1, s"$degrees degrees of freedom")
    if degrees <= Table.size then Table(degrees - 1)
    else
      val z = 1.959964
      val (cube, fifth) = (z * z * z, z * z * z * z * z)
      val n = degrees.toDouble
      z + (cube + z) / (4 * n) + (5 * fifth + 16 * cube + 3 * z) / (96 * n * n)

  private val Table = Vector(
    12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622, 2.2281, //
    2.2010, 2.1788, 2.1604, 2.1448, 2.1314, 2.1199, 2.1098, 2.1009, 2.0930, 2.0860, //
    2.0796, 2.0739, 2.0687, 2.0639, 2.0595, 2.0555, 2.0518, 2.0484, 2.0452, 2.0423
  )
