package candela.render

import candela.film.PixelBounds

import org.scalatest.funsuite.AnyFunSuite

class ForecastSuite extends AnyFunSuite:
  private val planned = 4096

  /** After twenty seconds of ten samples each. */
  private def outlook(ends: Option[ExpectedEnd]): Outlook =
    val forecast = this.forecast(ends)
    (1 to 20).map(s => forecast.outlook(10L * s * 64 * 64, planned, s, s)).last

  private def forecast(ends: Option[ExpectedEnd]) =
    val listener = new RenderListener:
      override def goal: Option[ExpectedEnd] = ends
    val schedule = TileSchedule(PixelBounds(0, 0, 64, 64), planned)
    Forecast(schedule, 64 * 64, 0, 1, listener)

  private def byError(samples: Option[SampleRange], time: Option[Double] = None) =
    outlook(Some(ExpectedEnd(time, true, samples)))

  test("the samples that an error needs are told, at most those that are planned"):
    assert(byError(Some(SampleRange(96, 64, 128))).samples.contains(SampleRange(96, 64, 128)))
    val far = byError(Some(SampleRange(6000, 3000, Int.MaxValue))).samples
    assert(far.exists(r => r.expected == planned && r.high == planned && r.low < planned))

  test("while nobody knows when an error is reached, the samples that are planned are no end"):
    val unknown = byError(None)
    assert(unknown.samples.isEmpty && unknown.left.isEmpty && unknown.between.isEmpty)
    assert(unknown.hasGoal)
    // A time ends it in any case
    assert(byError(None, Some(60)).left.contains(40.0))

  test("a time is told as seconds, not as samples"):
    val timed = outlook(Some(ExpectedEnd(Some(60), false, None)))
    assert(timed.samples.isEmpty && timed.left.exists(_ <= 40))
    assert(outlook(None).samples.isEmpty)

  test("a JVM that has rendered is as warm for the next rendering"):
    val first = forecast(None)
    // Not every system tells the processor time
    while first.warm.exists(_ < 0.1) do ()
    assert(first.warm.isEmpty || forecast(None).warm.exists(_ >= 0.1))
