package candela.bench.statistics

import candela.measure.{Errors, Interval, LogLogFit, Metric}

/** One rendered image.
  *
  * @param seconds of the whole process
  * @param memory  its peak resident memory in bytes, if known
  * @param parts   its squared error, taken apart
  */
final case class Measurement(
    samples: Int,
    seed: Int,
    seconds: Double,
    errors: Errors,
    memory: Option[Long] = None,
    parts: Option[ErrorParts] = None
)

/** All images of one sample count.
  *
  * @param seconds median over the runs, robust against disturbed runs
  */
final case class MeasuredPoint(samples: Int, seconds: Double, runs: Vector[Measurement]):

  private val parts = runs.flatMap(_.parts)

  /** Mean over the seeds, an estimate of the expected error. None if a run lacks this metric. */
  def apply(metric: Metric): Option[Interval] =
    val figures = runs.map(_.errors(metric))
    Option.when(figures.forall(_.isDefined)):
      val ofParts = parts.flatMap(_(metric))
      if ofParts.size == runs.size then ErrorInterval.of(ofParts).interval
      else Statistics.mean(figures.flatten)

  /** Standard deviation of an image's error over the seeds. None for one seed. */
  def deviation(metric: Metric): Option[Double] =
    val figures = runs.flatMap(_.errors(metric))
    Option.when(figures.size == runs.size && figures.sizeIs > 1)(Statistics.deviation(figures))

  /** Share of the worst hundredth of pixels in the relative MSE, if known. */
  def worst: Option[Double] =
    val shares = parts.map(p => (p.relative.sum, p.worst))
    Option.when(shares.nonEmpty && shares.map(_._1).sum > 0):
      shares.map(_ * _).sum / shares.map(_._1).sum

  /** The error spectrum ensemble, if known. */
  def spectrum: Vector[SpectrumBand] = ErrorSpectrum.ensemble(parts.map(_.spectrum))

/** Error of one program on one scene against samples and time.
  *
  * @param measurements one per independent seed; for unseeded programs, one per sample count
  * @param times times of all runs, by sample count
  */
final class MeasuredCurve(measurements: Vector[Measurement], times: Map[Int, Vector[Double]]):

  val points: Vector[MeasuredPoint] =
    measurements.groupBy(_.samples).toVector.sortBy(_._1).map: (samples, runs) =>
      MeasuredPoint(samples, Statistics.median(times(samples)), runs.sortBy(_.seed))

  /** Slope of the relative MSE against samples, per seed: −1 for unbiased independent samples,
    * steeper for low-discrepancy samples.
    */
  def slope: Option[Interval] =
    val slopes = measurements.groupBy(_.seed).values.toVector.flatMap: runs =>
      LogLogFit.slope(runs.map(r => (r.samples.toDouble, r.errors.relativeMse)))
    Option.when(slopes.nonEmpty)(Statistics.mean(slopes))

  /** 1 / (relative MSE · seconds) of the longest renderings: twice the efficiency halves the time
    * for equal noise. None if the error is 0.
    *
    * After Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, §2.2.
    */
  def efficiency: Option[Interval] =
    for
      point <- points.lastOption
      error <- point(Metric.RelativeMse)
      if error.estimate > 0
    yield (error * Math.max(point.seconds, 1e-9)).inverse

  /** Time in seconds until the expected relative MSE is at most this; see [[LogLogFit.firstAt]].
    * Its limits are where the curve is when the errors there may be as low, or as high, as their
    * intervals allow: 0 if it may be there from the beginning, infinite if the curve doesn't fall
    * so far.
    */
  def secondsUntil(relativeMse: Double): Option[Interval] =
    val estimates = curve(_.estimate)
    LogLogFit.firstAt(estimates, relativeMse).map: estimate =>
      val errors = points.flatMap(p => p(Metric.RelativeMse).map((p.seconds, _))).sortBy(_._1)
      if !errors.forall(_._2.isKnown) then Interval(estimate, Double.NaN, Double.NaN)
      else
        val (down, up) = CurveDoubts.at(errors, estimate)
        val begins = estimates.head._2 <= relativeMse * down
        Interval(
          estimate,
          if begins then 0 else LogLogFit.firstAt(estimates, relativeMse * down).getOrElse(0),
          LogLogFit.firstAt(estimates, relativeMse / up).getOrElse(Double.PositiveInfinity)
        )

  /** Mean relative MSE at this time; see [[LogLogFit.at]]. */
  def errorAt(seconds: Double): Option[Double] = LogLogFit.at(curve(_.estimate), seconds)

  /** From the shortest to the longest renderings, in seconds. */
  def span: Option[(Double, Double)] =
    val errors = curve(_.estimate)
    Option.when(errors.nonEmpty)((errors.map(_._1).min, errors.map(_._1).max))

  def lowestError: Double = curve(_.estimate).map(_._2).minOption.getOrElse(Double.PositiveInfinity)

  /** The largest peak memory of all runs, in bytes, if known. */
  def memory: Option[Long] = measurements.flatMap(_.memory).maxOption

  /** Mean ratio of the longest renderings, averaged over the seeds. */
  def meanRatio: Vector[Double] =
    val ratios = points.lastOption.toVector.flatMap(_.runs.map(_.errors.meanRatio))
    if ratios.isEmpty then Vector.empty else ratios.transpose.map(c => c.sum / c.size)

  private def curve(figure: Interval => Double): Vector[(Double, Double)] =
    points.flatMap(p => p(Metric.RelativeMse).map(i => (p.seconds, figure(i))))

/** What the limits of errors make of limits in time. */
private object CurveDoubts:
  /** Of the errors of the same seeds after twice as many samples: those are in both images. If
    * noise is normal, and samples independent.
    */
  private val Correlation = 0.5

  /** By what factor the curve may be too high, and too low, between two of its points.
    *
    * @param errors by seconds, in their order
    */
  def at(errors: Vector[(Double, Interval)], seconds: Double): (Double, Double) =
    val after = errors.indexWhere(_._1 >= seconds)
    val next = errors(if after < 0 then errors.size - 1 else after)
    val last = if after > 0 then errors(after - 1) else next
    val width = Math.log(next._1 / last._1)
    val fraction = if width > 0 then Math.log(seconds / last._1) / width else 0.0
    def together(far: Interval => Double): Double =
      val (a, b) = ((1 - fraction) * Math.log(far(last._2)), fraction * Math.log(far(next._2)))
      // Zero times an infinite logarithm: the other point is that of the curve
      if fraction <= 0 then far(last._2)
      else if fraction >= 1 then far(next._2)
      else Math.exp(Math.sqrt(a * a + b * b + 2 * Correlation * a * b))
    (together(i => i.estimate / i.low), together(i => i.high / i.estimate))
