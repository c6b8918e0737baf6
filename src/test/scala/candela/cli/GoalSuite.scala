package candela.cli

import candela.color.Rgb
import candela.film.Development
import candela.render.{Progress, Renderer, Rendering, TinyPlan}

import org.scalatest.funsuite.AnyFunSuite

class GoalSuite extends AnyFunSuite:
  /** Uniform numbers around 1: their relative error is the root of 1/12 over the samples. */
  private val plan = TinyPlan(width = 40, height = 30, spp = 1000): (_, sampler) =>
    Rgb.gray(0.5f + sampler.next1D())

  private def goal(options: FilmOptions) =
    Goal(options, 1000, RenderRecorder(Development(), None))

  private def rendered(goal: Goal): Rendering = Renderer.render(plan, 2, passObserver = Some(goal))

  test("a rendering ends at the first samples whose error is low enough, with whole passes"):
    // The root of 0.0833 / 44: past 32, before 64
    val rendering = rendered(goal(FilmOptions(error = Some(0.0436))))
    assert(rendering.samplesDone == 48 && rendering.isComplete)
    assert(rendering.samplesTaken == 48 * 40 * 30)

  test("an error of a few samples ends nothing"):
    assert(rendered(goal(FilmOptions(error = Some(10)))).samplesDone == Goal.Fewest)

  test("what remains is the time to the error, by its trend"):
    val ended = goal(FilmOptions(error = Some(0.0436)))
    val rendering = rendered(ended)
    val taken = rendering.samplesTaken
    val early = ended.outlook(Progress(taken / 2, 1000 * 1200, 3.0))
    // 24 samples in 3 s; 44 are needed: ± 10 %
    assert(Math.abs(early.secondsLeft.get - 2.5) < 0.7)
    assert(Math.abs(early.error.get * Math.sqrt(24 * 12) - 1) < 0.08)

  test("what remains is never more than the time that was given"):
    val timed = goal(FilmOptions(time = Some(5)))
    assert(timed.outlook(Progress(1200, 1000 * 1200, 3.0)).secondsLeft.contains(2.0))
    assert(timed.outlook(Progress(0, 1000 * 1200, 0.0)) == Outlook(Some(5.0), None))

  test("what ends before its goal because all samples are taken says so, and what to do"):
    def missed(options: FilmOptions) =
      val ended = goal(options)
      ended.missed(rendered(ended))
    val why = "all 1000 samples per pixel are taken; a larger --spp allows more"
    // The root of 0.0833 / 1000
    val noisy = missed(FilmOptions(error = Some(1e-4))).get
    assert(noisy.matches(raw"warning: the error is 0\.9\d* %, not 0\.01 %: " + why))
    val early = missed(FilmOptions(time = Some(3600))).get
    assert(early.matches(raw"warning: the rendering ended after [\d.]+ m?s, not .*: " + why))
    val both = missed(FilmOptions(error = Some(1e-4), time = Some(3600))).get
    assert(both.contains("not 0.01 %, and the rendering ended after "))
    assert(missed(FilmOptions(error = Some(0.5))).isEmpty)
    assert(missed(FilmOptions(time = Some(1e-6))).isEmpty)

  test("a time ends a rendering with whole passes"):
    val rendering = rendered(goal(FilmOptions(time = Some(1e-6))))
    assert(rendering.samplesDone == 1 && rendering.samplesTaken == 1200)
