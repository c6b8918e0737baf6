package candela.render

/** What is expected of a rendering in progress.
  *
  * @param pixels  that take a sample each, on average, for one sample per pixel
  * @param earlier samples per pixel that it began with
  */
private[render] final class Forecast(
    schedule: Schedule,
    pixels: Double,
    earlier: Int,
    listener: RenderListener
):
  private val timeLeft = TimeLeft()

  /** @param done    samples taken
    * @param planned samples per pixel at which it ends in any case
    * @param seconds since the start of rendering, without the listeners' time
    * @param clock   with the listeners' time
    */
  def outlook(done: Long, planned: Int, seconds: Double, clock: Double): Outlook =
    val samples = earlier + done / Math.max(1, pixels)
    timeLeft.add(samples, sweep(samples), seconds)
    val goal = listener.goal
    val end = goal.flatMap(_.samples).map(schedule.wholeWaves)
    val last = Math.min(planned, end.getOrElse(planned))
    val isKnown = last < RenderPlan.Endless
    val bySamples = Option.when(isKnown)(timeLeft.until(last, seconds)).flatten
    val byTime = goal.flatMap(_.seconds).map(t => Math.max(0, t - clock))
    Outlook(
      (bySamples ++ byTime).minOption,
      timeLeft.rate.map(_ * pixels),
      listener.errorAt(samples),
      goal.isDefined
    )

  /** The wave that the latest samples belong to. */
  private def sweep(samples: Double): TimeLeft.Sweep =
    val wave = schedule.waveOf(Math.min(samples, Int.MaxValue - 1.0).toInt)
    TimeLeft.Sweep(schedule.firstSample(wave), schedule.endSample(wave))
