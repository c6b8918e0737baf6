package candela.bench.suite

/** Render time of a program over the number of samples per pixel, from trial runs.
  *
  * @param points counts, from 1 on in rising order, each with its seconds
  */
private[suite] final case class TimeCurve(points: Vector[(Int, Double)]):
  import TimeCurve.*

  /** With another trial, or with the latest of as many samples. */
  def and(samples: Int, seconds: Double): TimeCurve =
    TimeCurve((points.filterNot(_._1 == samples) :+ (samples -> seconds)).sortBy(_._1))

  /** Number of samples that take `seconds`, one at least: linear between trials and beyond the
    * last. Programs that compile while they render are faster per sample the longer they take.
    */
  def samplesIn(seconds: Double): Int =
    // Trials that took no longer than those before say nothing: noise, or start-up
    val rising = points.tail.foldLeft(points.take(1)): (ascending, p) =>
      if p._2 > ascending.last._2 then ascending :+ p else ascending.init :+ p
    val upperIndex = Math.max(
      1,
      rising.indexWhere(_._2 > seconds) match
        case -1 => rising.size - 1
        case i => i
    )
    val exact =
      if rising.size == 1 then
        val (samples, time) = rising.head
        seconds * samples / Math.max(time, samples * Fastest)
      else
        val (n0, t0) = rising(upperIndex - 1)
        val (n1, t1) = rising(upperIndex)
        n0 + (seconds - t0) / Math.max(Fastest, (t1 - t0) / (n1 - n0))
    Math.max(1, Math.min(exact, MaxSamples).toInt)

  /** Samples of the next trial; None if the last took so long that longer runs of up to `budget`
    * seconds are foreseeable.
    */
  def nextTrial(budget: Double): Option[Int] =
    val (last, time) = points.last
    val wanted =
      if points.size == 1 then last * FirstStep
      else Math.min(last * LargestStep, samplesIn(budget / 2))
    Option.when(time < 0.4 * budget && wanted > last)(wanted)

private[suite] object TimeCurve:
  /** Seconds per sample: no program renders ten thousand samples in a second. */
  private val Fastest = 1e-4

  /** Of a time budget: times beyond count as unequal. */
  private val Tolerance = 0.1
  private val MaxSamples = 1e7
  private val FirstStep = 8
  private val LargestStep = 16

  def isFar(seconds: Double, budget: Double): Boolean =
    Math.abs(seconds / budget - 1) > Tolerance

  /** Runs trials until runs of up to `budget` seconds are foreseeable; None if one fails.
    *
    * @param seconds runs a trial of so many samples
    */
  def measured(budget: Double)(seconds: Int => Option[Double]): Option[TimeCurve] =
    def further(curve: TimeCurve): Option[TimeCurve] =
      curve.nextTrial(budget) match
        case None => Some(curve)
        case Some(samples) => seconds(samples).flatMap(s => further(curve.and(samples, s)))
    seconds(1).flatMap(s => further(TimeCurve(Vector(1 -> s))))
