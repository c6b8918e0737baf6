package candela.measure

/** One image that a program made: with which seed, how fast, how wrong. */
final case class Measurement(samples: Int, seed: Int, seconds: Double, errors: Errors)

/** All images of one sample count.
  *
  * @param seconds median over the runs: a run that was disturbed counts no more than another one
  */
final case class MeasuredPoint(samples: Int, seconds: Double, runs: Vector[Measurement]):

  /** The mean over the seeds, which is what the expected error is estimated by. None if a run
    * hasn't this figure.
    */
  def apply(metric: Metric): Option[Interval] =
    val figures = runs.map(_.errors(metric))
    Option.when(figures.forall(_.isDefined))(Interval.ofMean(figures.flatten))

/** How the error of one program on one scene falls while it works.
  *
  * @param measurements of independent seeds; of programs that have none, one for each sample count
  * @param times        of all runs, by sample count
  */
final class MeasuredCurve(measurements: Vector[Measurement], times: Map[Int, Vector[Double]]):

  val points: Vector[MeasuredPoint] =
    measurements.groupBy(_.samples).toVector.sortBy(_._1).map: (samples, runs) =>
      MeasuredPoint(samples, Interval.median(times(samples)), runs.sortBy(_.seed))

  /** Of the relative squared error over samples, of each seed alone: −1 without bias and with
    * independent samples, steeper with points that are spread evenly.
    */
  def slope: Option[Interval] =
    val slopes = measurements.groupBy(_.seed).values.toVector.flatMap: runs =>
      LogLogFit.slope(runs.map(r => (r.samples.toDouble, r.errors.relativeMse)))
    Option.when(slopes.nonEmpty)(Interval.ofMean(slopes))

  /** 1 / (relative MSE · seconds) of the longest renderings: twice the efficiency needs half the
    * time for the same noise. None if the error is 0.
    *
    * After Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, §2.2.
    */
  def efficiency: Option[Interval] =
    points.lastOption.filter(_.runs.forall(_.errors.relativeMse > 0)).map: point =>
      val seconds = Math.max(point.seconds, 1e-9)
      Interval.ofGeometricMean(point.runs.map(r => 1 / (r.errors.relativeMse * seconds)))

  /** Seconds until the mean relative MSE is at most this; see [[LogLogFit.firstAt]]. */
  def secondsUntil(relativeMse: Double): Option[Double] =
    LogLogFit.firstAt(curve, relativeMse)

  def least: Double = curve.map(_._2).minOption.getOrElse(Double.PositiveInfinity)

  /** Of the longest renderings, the mean over the seeds. */
  def meanRatio: Vector[Double] =
    val ratios = points.lastOption.toVector.flatMap(_.runs.map(_.errors.meanRatio))
    if ratios.isEmpty then Vector.empty else ratios.transpose.map(c => c.sum / c.size)

  private def curve: Vector[(Double, Double)] =
    points.flatMap(p => p(Metric.RelativeMse).map(i => (p.seconds, i.estimate)))

/** Straight lines through curves whose axes are both logarithmic. */
object LogLogFit:

  /** The slope by least squares; −1 for the squared error of independent samples. None if there are
    * fewer than two different places. Points that have no logarithm are left out.
    */
  def slope(points: Vector[(Double, Double)]): Option[Double] =
    val logs = points.collect { case (x, y) if x > 0 && y > 0 => (Math.log(x), Math.log(y)) }
    if logs.map(_._1).distinct.sizeIs < 2 then None
    else
      val meanX = logs.map(_._1).sum / logs.size
      val meanY = logs.map(_._2).sum / logs.size
      val together = logs.map((x, y) => (x - meanX) * (y - meanY)).sum
      Some(together / logs.map((x, _) => (x - meanX) * (x - meanX)).sum)

  /** Where the curve first comes down to `y`, by a straight line between the neighbours. None if it
    * doesn't: nothing is guessed beyond what was measured. A curve that begins below `y` was there
    * at its first point at the latest.
    */
  def firstAt(points: Vector[(Double, Double)], y: Double): Option[Double] =
    val curve = points.filter((x, e) => x > 0 && e > 0).sortBy(_._1)
    curve.indexWhere(_._2 <= y) match
      case -1 => None
      case 0 => Some(curve.head._1)
      case i =>
        val ((x0, y0), (x1, y1)) = (curve(i - 1), curve(i))
        val part = (Math.log(y0) - Math.log(y)) / (Math.log(y0) - Math.log(y1))
        Some(Math.exp(Math.log(x0) + part * (Math.log(x1) - Math.log(x0))))
