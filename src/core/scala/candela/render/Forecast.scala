package candela.render

import scala.jdk.OptionConverters.*

/** What is expected of a rendering in progress.
  *
  * @param pixels  that take a sample each, on average, for one sample per pixel
  * @param earlier samples per pixel that it began with
  * @param workers that take samples
  */
private[render] final class Forecast(
    schedule: Schedule,
    pixels: Double,
    earlier: Int,
    workers: Int,
    listener: RenderListener
):
  private val timeLeft = TimeLeft()
  private val begun = Forecast.begun

  /** @param done    samples taken
    * @param planned samples per pixel at which it ends in any case
    * @param seconds since the start of rendering, without the listeners' time
    * @param clock   with the listeners' time
    */
  def outlook(done: Long, planned: Int, seconds: Double, clock: Double): Outlook =
    val samples = earlier + done / Math.max(1, pixels)
    timeLeft.add(samples, sweep(samples), seconds)
    val goal = listener.goal
    val isByError = goal.exists(_.isByError)
    val end =
      if isByError then goal.flatMap(_.samples).map(_.map(atEnd).atMost(planned))
      else Option.when(planned < RenderPlan.Endless)(SampleRange(planned, planned, planned))
    val left = end.filter(_.expected < RenderPlan.Endless).flatMap(timeLeft.until(_, seconds, warm))
    val byTime = goal.flatMap(_.seconds).map(t => Math.max(0, t - clock))
    val both = byTime.fold(left)(t => Some(left.fold(TimeRange(t, t, t))(_.atMost(t))))
    Outlook(
      both.filter(_.isKnown(seconds)).map(_.expected),
      timeLeft.rate.map(_ * pixels),
      listener.errorAt(samples),
      goal.isDefined,
      both.filter(r => !r.isKnown(seconds) && r.says(seconds)),
      end.filter(_ => isByError)
    )

  /** Where a rendering ends whose goal is reached with so many samples per pixel. */
  private def atEnd(samples: Int): Int =
    if schedule.step > 0 || samples == Int.MaxValue then samples else schedule.wholeWaves(samples)

  /** Seconds of processor time that each worker could have had in this JVM so far, if the system
    * tells.
    */
  private[render] def warm: Option[Double] =
    for
      now <- Forecast.processor
      before <- begun
    yield (now - before) / Math.max(1, workers)

  /** The wave that the latest samples belong to. */
  private def sweep(samples: Double): TimeLeft.Sweep =
    val wave = schedule.waveOf(Math.min(samples, Int.MaxValue - 1.0).toInt)
    TimeLeft.Sweep(schedule.firstSample(wave), schedule.endSample(wave))

private object Forecast:
  /** That of this process when it began to render: what was compiled since then is compiled for
    * later renderings, too.
    */
  private lazy val begun: Option[Double] = processor

  /** Seconds of processor time of this process. */
  private def processor: Option[Double] =
    ProcessHandle.current.info.totalCpuDuration.toScala.map(_.toNanos * 1e-9)
