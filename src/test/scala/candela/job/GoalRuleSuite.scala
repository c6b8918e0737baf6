package candela.job

import candela.color.Rgb
import candela.film.{Development, Film, PixelBounds}
import candela.image.Image
import candela.render.{
  Looks, Pass, RenderControl, Renderer, Rendering, RenderPlan, StoppingRule, TinyPlan
}
import candela.settings.RenderGoal

import org.scalatest.funsuite.AnyFunSuite

class GoalRuleSuite extends AnyFunSuite:
  /** Uniform numbers around 1: their relative error is the root of 1/12 over the samples. */
  private def plan(spp: Int) = TinyPlan(width = 40, height = 30, spp = spp): (_, sampler) =>
    Rgb.gray(0.5f + sampler.next1D())

  private def goal(options: RenderGoal) =
    GoalRule(options, 1000, ErrorRecorder(Development(), None))

  private def rendered(rule: GoalRule, spp: Int = 1000): Rendering =
    Renderer.render(plan(spp), RenderControl(2, rule = rule))

  test("a rendering ends at the first number of samples whose error is low enough"):
    // The root of 0.0833 / 41, relative to 1.01; the estimate is known to 5 %
    val rendering = rendered(goal(RenderGoal(error = Some(0.045))))
    assert(Math.abs(rendering.samplesDone - 41) <= 4 && rendering.isComplete)
    assert(rendering.samplesTaken == rendering.samplesDone * 40 * 30)

  test("the last point is that of the image, wherever the goal ended it"):
    val estimating = ErrorRecorder(Development(), None)
    val rendering = rendered(GoalRule(RenderGoal(error = Some(0.045)), 1000, estimating))
    val samples = rendering.samplesDone
    val measuring =
      ErrorRecorder(Development(), Some(Image(40, 30, Image.RgbNames, Array.fill(3600)(1f))))
    for recorder <- Vector(estimating, measuring) do
      recorder.ended(rendering)
      val last = recorder.points.last
      assert(last.samples == samples && last.seconds <= rendering.seconds)
      assert(Math.abs(last.errors.relativeMse * samples * 12 - 1) < 0.15)
      // Once
      recorder.ended(rendering)
      assert(recorder.points.count(_.samples == samples) == 1)

  test("an error of a few samples ends nothing"):
    assert(rendered(goal(RenderGoal(error = Some(10)))).samplesDone == GoalRule.MinSamples)

  test("the samples that an error needs are known before"):
    val ended = goal(RenderGoal(error = Some(0.045)))
    val samples = rendered(ended).samplesDone
    val expected = ended.expectedEnd.get
    assert(expected.seconds.isEmpty && expected.samples.exists(_.expected == samples))
    assert(Math.abs(ended.errorAt(24).get * Math.sqrt(24 * 12) - 1) < 0.08)

  test("a preview takes a sample of each pixel, whatever the time"):
    val recorder = ErrorRecorder(Development(), None)
    val late = GoalRule(RenderGoal(time = Some(1e-9)), 16, recorder, finishesFirstSample = true)
    val rendering = rendered(late, spp = 16)
    assert(rendering.isComplete && rendering.samplesDone >= 1)
    val timed = GoalRule(RenderGoal(time = Some(1)), 16, recorder, finishesFirstSample = true)
    assert(!timed.stopsNow(99, 99))
    assert(GoalRule(RenderGoal(time = Some(1)), 16, recorder).stopsNow(99, 99))

  test("nothing is asked of a rendering that has ended, however many waves it might have had"):
    var asked = 0
    val rule = new StoppingRule:
      override def frequency: Looks = Looks.Waves
      override def stopsAfterPass: Boolean =
        asked += 1
        asked > 5
    val endless = plan(1000).copy(samples = Some(RenderPlan.Endless))
    assert(Renderer.render(endless, RenderControl(2, rule = rule)).samplesDone >= 1)
    assert(asked < 100)

  test("it says what ended the rendering"):
    val byError = goal(RenderGoal(time = Some(1e6), error = Some(0.2)))
    val rendering = rendered(byError)
    assert(byError.endedBy(rendering) == GoalRule.Ending.Error)
    val timed = goal(RenderGoal(time = Some(1), error = Some(1e-9)))
    timed.begins(0, 0, film)
    timed.passed(Pass(1, 0, 1, Vector.empty, clock = 1), film)
    assert(timed.endedBy(rendering) == GoalRule.Ending.Time)
    assert(timed.endedBy(rendering.copy(samplesDone = 1000)) == GoalRule.Ending.Samples)

  private val film = Film(PixelBounds(0, 0, 1, 1))

  /** When a rendering ends whose samples take a second each, the first one, and then `actual`
    * seconds.
    *
    * @param largest samples per pixel of a pass
    */
  private def ended(time: Double, largest: Int, actual: Double = 1): Double =
    val timed = goal(RenderGoal(time = Some(time)))
    timed.begins(0, 0, film)
    var clock = 0.0
    var samples = 0
    while !timed.stopsAfterPass do
      val size = Math.min(largest, Math.max(1, Integer.highestOneBit(samples) / 2))
      val rest = size - samples % size
      val next = Math.min(timed.maxSamples, rest)
      val end = clock + next * (if samples == 0 then 1 else actual)
      samples += next
      timed.passed(
        Pass(samples, clock, end, Vector.empty, isUnshortened = next == rest, clock = end),
        film
      )
      clock = end
    clock

  test("a time ends a rendering after a part that ends near it, however long passes are"):
    assert(ended(20, 64) == 20)
    assert(ended(20.3, 1) == 20)
    assert(Math.abs(ended(100, 16, actual = 1.2) - 100) <= 1)
    // Another sample would end late
    assert(ended(20.55, 1) == 20)

  test("a film is continued by a sample that tells how long they take"):
    val timed = goal(RenderGoal(time = Some(4)))
    timed.begins(64, 64, film)
    assert(timed.maxSamples == 1)

  test("a slow start does not end a rendering before its time"):
    val timed = goal(RenderGoal(time = Some(1.2)))
    timed.begins(0, 0, film)
    timed.passed(Pass(1, 0, 0.8, Vector.empty, clock = 0.8), film)
    assert(!timed.stopsAfterPass && timed.maxSamples == 2)

  test("samples that take longer than expected are not waited for, nor chains, which end anywhere"):
    val timed = goal(RenderGoal(time = Some(20)))
    timed.begins(0, 0, film)
    for i <- 1 to 3 do timed.passed(Pass(i, i - 1, i, Vector.empty, clock = i), film)
    assert(timed.maxSamples == 17 && !timed.stopsNow(20.3, 0) && timed.stopsNow(20.5, 0))
    val chains = goal(RenderGoal(time = Some(20)))
    chains.begins(0, 0, film)
    chains.passed(Pass(1, 0, 1, Vector.empty, clock = 1, step = 0), film)
    assert(!chains.stopsAfterPass && !chains.stopsNow(19.9, 0) && chains.stopsNow(20, 0))

  test("an error is measured in time, or not at all"):
    for (clock, isKnown) <- Vector(2.0 -> true, 2.9 -> false) do
      val timed = goal(RenderGoal(time = Some(2)))
      timed.begins(0, 0, film)
      for i <- 1 to 2 do
        timed.passed(Pass(i, 0, 1, Vector.empty, clock = if i == 1 then 1 else clock), film)
      assert(timed.errorAt(2).isDefined == isKnown && timed.stopsAfterPass, clock)
    val cancelled = goal(RenderGoal(error = Some(1e9)))
    cancelled.begins(0, 0, film)
    for i <- 1 to 2 do cancelled.passed(Pass(i, 0, 1, Vector.empty, isStopped = () => true), film)
    assert(cancelled.errorAt(2).isEmpty)

  test("where an error is looked at does not depend on a time"):
    val both = goal(RenderGoal(error = Some(1e9), time = Some(1000)))
    both.begins(0, 0, film)
    both.passed(Pass(8, 0, 1, Vector.empty, isUnshortened = false, clock = 1), film)
    assert(!both.stopsAfterPass)
    // An end that the time cuts short is not the error's
    val error = Some(0.045)
    val alone = rendered(goal(RenderGoal(error = error))).samplesDone
    for time <- Vector(1e-3, 2e-3, 5e-3, 0.01, 0.02) do
      val timed = goal(RenderGoal(error = error, time = Some(time)))
      assert(rendered(timed).samplesDone <= alone)
    val late = goal(RenderGoal(error = error, time = Some(100)))
    assert(rendered(late).samplesDone == alone)

  test("an error that is low enough with the last sample is no goal that was missed"):
    val ends =
      for planned <- Vector(9, 17, 18, 34, 70, 131) yield
        val trend = ErrorRecorder(Development(), None)
        rendered(GoalRule(RenderGoal(error = Some(1e-9)), planned, trend), planned): Unit
        val most = trend.errorAt(planned).get * 1.0001
        val reached =
          GoalRule(RenderGoal(error = Some(most)), planned, ErrorRecorder(Development(), None))
        val rendering = rendered(reached, planned)
        assert(!reached.isMissed(rendering), planned)
        planned - rendering.samplesDone
    // Earlier looks may have expected less
    assert(ends.contains(0), ends)

  test("a time ends a rendering with whole passes"):
    val rendering = rendered(goal(RenderGoal(time = Some(1e-6))))
    assert(rendering.samplesDone == 1 && rendering.samplesTaken == 1200)
