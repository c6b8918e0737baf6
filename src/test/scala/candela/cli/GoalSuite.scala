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

  test("a time ends a rendering with whole passes"):
    val rendering = rendered(goal(FilmOptions(time = Some(1e-6))))
    assert(rendering.samplesDone == 1 && rendering.samplesTaken == 1200)
