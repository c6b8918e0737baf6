package candela.render

import scala.collection.mutable

/** Estimates when a rendering ends: elapsed × rest / done, over the last half of the samples taken.
  *
  * Two waves double the samples, so the last half has each pixel about equally often, though pixels
  * cost differently. The slow start of a JVM is soon in the first half. Not thread-safe.
  *
  * @param pixels  that take a sample each, on average, for one sample per pixel
  * @param earlier samples per pixel that it began with
  */
private[render] final class TimeLeft(
    schedule: Schedule,
    pixels: Double,
    earlier: Int,
    rule: StoppingRule,
    listener: RenderListener
):
  import TimeLeft.*

  // The first is where the last half begins
  private val readings = mutable.ArrayDeque(Reading(0, 0))
  private var last = readings.head

  /** @param done    samples taken
    * @param planned samples per pixel at which it ends in any case
    * @param seconds since the start of rendering, without the time of listeners
    * @param clock   with the time of listeners
    */
  def outlook(done: Long, planned: Int, seconds: Double, clock: Double): Outlook =
    add(Reading(done, seconds))
    val goal = rule.expectedEnd
    val byError = goal.filter(_.isByError).map(_.samples.map(_.map(atEnd).atMost(planned)))
    val end = byError.fold(Some(planned))(_.map(_.expected)).filter(_ < RenderPlan.Endless)
    val bySamples =
      for n <- end; r <- rate if seconds >= FirstSeconds
      yield ((n - earlier) * pixels - last.done) / r - (seconds - last.seconds)
    val byTime = goal.flatMap(_.seconds).map(_ - clock)
    Outlook(
      (bySamples ++ byTime).minOption.map(Math.max(0, _)),
      rate,
      listener.errorAt(earlier + done / Math.max(1, pixels)),
      goal.isDefined,
      byError.flatten
    )

  private def add(reading: Reading): Unit =
    if reading.done == 0 then
      // What precedes the first samples doesn't happen again
      readings(0) = reading
      last = reading
    else if reading.done > last.done then
      last = reading
      if reading.done >= readings.last.done * Spacing then readings += reading
      while readings.size > 1 && 2 * readings(1).done <= reading.done do
        readings.removeHead(): Unit

  /** Samples per second. */
  private def rate: Option[Double] =
    val oldest = readings.head
    Option.when(last.seconds > oldest.seconds):
      (last.done - oldest.done) / (last.seconds - oldest.seconds)

  /** Where a rendering ends whose goal is reached with so many samples per pixel. */
  private def atEnd(samples: Int): Int =
    if schedule.step > 0 || samples == Int.MaxValue then samples else schedule.wholeWaves(samples)

private object TimeLeft:
  /** @param done samples taken */
  private final case class Reading(done: Long, seconds: Double)

  /** In seconds: JVMs compile the hot loops meanwhile. */
  private val FirstSeconds = 2.0

  /** Readings have at least this many times the samples of the one before: 35 in the last half. */
  private val Spacing = 1.02
