package candela.bench.statistics

import candela.measure.Interval

import org.apache.commons.statistics.distribution.ChiSquaredDistribution

/** The expected squared error of a program's images, with its 95 % confidence interval, from images
  * of several seeds: each image's error in parts, which are squares of pixels.
  *
  * Squared errors are skewed, and where rare paths decide, a few of them are most of the error: a
  * mean over seeds is far from normal. But an image has many parts, and so three images tell the
  * variance well where parts are independent. Its degrees of freedom are Satterthwaite's
  * (Biometrics Bulletin 2, 1946), few if few parts decide. The distribution is taken for that of a
  * sum of weighted Poisson counts, whose upper limit allows for one more event (Fay, Feuer,
  * "Confidence intervals for directly standardized rates", Statistics in Medicine 16, 1997); how
  * large an event, is calibrated by docs/NOISE.md, "Intervals". Gamma quantiles are Wilson's and
  * Hilferty's (PNAS 17, 1931), with Student's for normal ones.
  *
  * Parts of an image whose pixels share random numbers have good and bad seeds in common. Where the
  * errors of whole images differ by more than those of independent parts would, their own variance
  * counts, with a degree of freedom less than there are images.
  *
  * @param events how many equal parts of the error would vary as much as the error does: its mean
  *   squared over its variance
  */
final case class ErrorInterval(interval: Interval, events: Double)

object ErrorInterval:
  /** Fewer events allow for no upper limit: what the next seed finds may outweigh all of them. */
  val MinEvents = 12.0

  /** How large an event the next seed may have, relative to the largest one's square over the
    * deviation of the mean: by docs/NOISE.md, "Intervals".
    */
  private val NextEvent = 1.5

  /** @param parts for each image, the share of each part in its error: their sum is the error */
  def of(parts: Vector[Array[Double]]): ErrorInterval =
    val seeds = parts.size
    require(seeds > 0, "no images")
    val mean = parts.map(_.sum).sum / seeds
    if seeds == 1 then ErrorInterval(Interval(mean, Double.NaN, Double.NaN), Double.NaN)
    else
      val imageSpread = Spread.of(Vector(parts.map(_.sum)), seeds)
      val partSpread = Spread.of(parts.head.indices.map(i => parts.map(_(i))), seeds)
      val spread =
        if imageSpread.variance > partSpread.variance * chance(seeds - 1) then imageSpread
        else partSpread
      limits(mean, partSpread, spread, seeds)

  private def limits(mean: Double, partSpread: Spread, spread: Spread, seeds: Int): ErrorInterval =
    if spread.variance <= 0 then ErrorInterval(Interval(mean, mean, mean), Double.PositiveInfinity)
    else
      val events = mean * mean / partSpread.variance
      val t = Statistics.studentLimit(spread.degrees)
      val low = gamma(mean, spread.variance, -t)
      val missed = NextEvent * (1 + 1.0 / seeds) * spread.largest * spread.largest /
        Math.sqrt(spread.variance)
      val high =
        if events < MinEvents then Double.PositiveInfinity
        else gamma(mean + missed, spread.variance + missed * missed, t)
      ErrorInterval(Interval(mean, low, high), events)

  /** Quantile of the gamma distribution of this mean and variance, by that of a normal one. */
  private def gamma(mean: Double, variance: Double, normal: Double): Double =
    val shape = mean * mean / variance
    val root = 1 - 1 / (9 * shape) + normal / (3 * Math.sqrt(shape))
    mean * Math.pow(Math.max(0, root), 3)

  /** The ratio of variances that independent parts exceed in a tenth of cases: the quantile of χ²
    * over its degrees of freedom.
    */
  private def chance(degrees: Int): Double =
    ChiSquaredDistribution.of(degrees).inverseSurvivalProbability(0.1) / degrees

  /** The variance of the mean over seeds, its degrees of freedom, and by how much the largest event
    * changes that mean.
    */
  private final case class Spread(variance: Double, degrees: Double, largest: Double)

  private object Spread:

    /** @param values of each independent part, one for each seed */
    def of(values: Iterable[Vector[Double]], seeds: Int): Spread =
      var variance, squares, largest = 0.0
      for seedValues <- values do
        val mean = seedValues.sum / seeds
        val partVariance = seedValues.map(v => (v - mean) * (v - mean)).sum / (seeds - 1) / seeds
        variance += partVariance
        squares += partVariance * partVariance
        largest = Math.max(largest, seedValues.max - mean)
      // The square of a variance from few seeds is too large by (seeds + 1) / (seeds − 1)
      val equal = if squares > 0 then variance * variance / squares else 1.0
      val degrees = equal * (seeds + 1) - 2
      Spread(variance, degrees, largest * Math.sqrt(seeds / (seeds - 1.0)) / seeds)
