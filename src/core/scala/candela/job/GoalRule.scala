package candela.job

import candela.film.Film
import candela.measure.Interval
import candela.render.{ExpectedEnd, Looks, Pass, Rendering, SampleRange, StoppingRule}
import candela.settings.RenderGoal

/** Stops a rendering at a time, or at an error, whichever comes first, with a whole number of
  * samples in every pixel. The error is low enough with as many samples as the latest estimate,
  * after 2, 4, 8, … samples, says that it needs: it is not measured again.
  *
  * @param goal                a time, an error, or both
  * @param planned             samples per pixel at which it ends in any case
  * @param recorder            measures the error
  * @param finishesFirstSample whether each pixel gets a sample, whatever the time
  * @param earlier             relative MSE of the image that the rendering begins with, if known
  * @param isLimited           whether a limit has set `planned`
  */
final class GoalRule(
    val goal: RenderGoal,
    planned: Int,
    recorder: ErrorRecorder,
    finishesFirstSample: Boolean = false,
    earlier: Option[Interval] = None,
    isLimited: Boolean = false
) extends StoppingRule:
  private var ending = Option.empty[GoalRule.Ending]
  private var samplesDone, step, passCount = 0
  private var elapsed, perSample = 0.0

  /** Samples per pixel at which the latest estimate expects the error to be low enough. */
  private var samplesNeeded = Option.empty[Int]
  private var samplesNeededRange = Option.empty[SampleRange]

  /** What ended a rendering. */
  def endedBy(rendering: Rendering): GoalRule.Ending =
    val isCut = rendering.samplesDone < planned
    ending.filter(_ == GoalRule.Ending.Error || isCut).getOrElse(bySamples)

  /** What ends it if no goal does. */
  val bySamples: GoalRule.Ending =
    if isLimited then GoalRule.Ending.Limit else GoalRule.Ending.Samples

  private def end(by: GoalRule.Ending): Unit = ending = ending.orElse(Some(by))

  override def stopsAfterPass: Boolean = ending.isDefined
  override def frequency: Looks = Looks.Waves

  override def begins(samples: Int, maxSamples: Int, film: Film): Unit =
    samplesDone = samples
    step = 1
    val error = earlier.map(e => Math.sqrt(e.estimate))
    if isLow(samples, error) then end(GoalRule.Ending.Error)
    else recorder.begins(samples, maxSamples, film)

  override def passed(pass: Pass, film: Film): Unit =
    val began = System.nanoTime
    def clock = pass.clock + (System.nanoTime - began) * 1e-9
    def isLate = goal.time.exists(clock > _ + GoalRule.MaxLateSeconds)
    val watched = pass.copy(isStopped = () => pass.isStopped() || isLate)
    // Shortened passes depend on the time; where the rendering ends by its error must not
    if pass.isUnshortened then
      recorder.passed(watched, film)
      val samples = goal.error.flatMap(recorder.samplesUntil)
      samplesNeeded = samples.map(s => GoalRule.roundedUp(s.estimate))
      samplesNeededRange = samples.flatMap(GoalRule.range)
    val hasSamples = samplesNeeded.exists(_ <= pass.samples)
    if hasSamples || pass.isLast && isLow(pass.samples, errorAt(pass.samples)) then
      end(GoalRule.Ending.Error)
    val measured = (pass.endSeconds - pass.beginSeconds) / Math.max(1, pass.samples - samplesDone)
    // The first ones are slow: the JVM compiles meanwhile
    perSample =
      measured * GoalRule.WarmUpFactors(Math.min(passCount, GoalRule.WarmUpFactors.size - 1))
    passCount += 1
    samplesDone = pass.samples
    step = pass.step
    elapsed = clock
    if goal.time.exists(t => !isWorthMore(t - elapsed)) then end(GoalRule.Ending.Time)
    if ending.isDefined && !pass.isUnshortened then
      recorder.passed(watched.copy(isLast = true), film)

  /** Whether the error after so many samples is low enough. */
  private def isLow(samples: Int, error: Option[Double]): Boolean =
    samples >= GoalRule.MinSamples && goal.error.exists(limit => error.exists(_ <= limit))

  /** Whether the shortest part that there is ends nearer to the time than now, and not late. */
  private def isWorthMore(remaining: Double): Boolean =
    remaining > step * perSample / 2 && step * perSample - remaining <= GoalRule.MaxLateSeconds

  /** As many samples as the error needs, or end in time. */
  override def maxSamples: Int =
    val inTime = goal.time.fold(Int.MaxValue): t =>
      val remaining = t - elapsed
      val fits =
        Math.min(remaining / perSample + 0.5, (remaining + GoalRule.MaxLateSeconds) / perSample)
      // The first one tells how long they take, also where a film has many
      if perSample == 0 then 1 else Math.max(1, Math.min(fits, Int.MaxValue)).toInt
    samplesNeeded.fold(inTime)(samples => Math.min(inTime, Math.max(1, samples - samplesDone)))

  /** At the time, if the rendering may end anywhere, or no sample ends any more; or else soon
    * after, if the samples take longer than expected.
    */
  override def stopsNow(seconds: Double, idleSeconds: Double): Boolean =
    val mayBeLate = step > 0 && idleSeconds <= GoalRule.MaxIdleSeconds
    val late = if mayBeLate then GoalRule.MaxLateSeconds else 0
    val mayEnd = !finishesFirstSample || samplesDone > 0
    if mayEnd && goal.time.exists(_ + late <= seconds) then end(GoalRule.Ending.Time)
    ending.isDefined

  override def expectedEnd: Option[ExpectedEnd] =
    Some(ExpectedEnd(goal.time, goal.error.isDefined, samplesNeededRange))

  override def errorAt(samples: Double): Option[Double] = recorder.errorAt(samples)

  /** Whether the rendering ended before its goal, because all samples were taken. */
  def isMissed(rendering: Rendering): Boolean =
    val isEarly = goal.time.forall(rendering.seconds < GoalRule.MinTimeFraction * _)
    ending.isEmpty && isEarly && rendering.samplesDone >= planned

object GoalRule:
  /** @param setting by which it is asked for */
  enum Ending(val setting: String):
    case Time extends Ending("time")
    case Error extends Ending("error")
    case Samples extends Ending("spp")
    case Limit extends Ending("limit samples")

  /** Of a time; what ends later was asked for. */
  private val MinTimeFraction = 0.9

  /** No regular sample takes longer without any progress. */
  private val MaxIdleSeconds = 0.5

  /** A rendering may end this much late, including the time until its workers have ended. */
  private val MaxLateSeconds = 0.4

  /** What a sample is expected to take after each part, relative to those of the part. If it takes
    * longer, the rendering ends in the midst of it, in time.
    */
  private val WarmUpFactors = Vector(0.25, 0.5, 1.0)

  /** Fewer samples per pixel say little about an error: their halves leave gaps. */
  val MinSamples = 8

  /** The samples with which a goal may be reached, if they are known. */
  private[candela] def range(samples: Interval): Option[SampleRange] =
    Option.when(samples.isKnown)(SampleRange(
      roundedUp(samples.estimate),
      roundedUp(samples.low),
      roundedUp(samples.high)
    ))

  private[candela] def roundedUp(samples: Double): Int =
    Math.max(MinSamples, Math.min(Math.ceil(samples), Int.MaxValue).toInt)
