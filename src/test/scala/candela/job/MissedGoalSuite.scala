package candela.job

import candela.color.Rgb
import candela.film.Development
import candela.render.{RenderControl, Renderer, TinyPlan}
import candela.settings.RenderGoal

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

class MissedGoalSuite extends AnyFunSuite:
  /** Uniform numbers around 1: their relative error is the root of 1/12 over the samples. */
  private val plan = TinyPlan(width = 40, height = 30, spp = 1000): (_, sampler) =>
    Rgb.gray(0.5f + sampler.next1D())

  test("what ends before its goal because all samples are taken says so, and what to do", Slow):
    def missed(options: RenderGoal) =
      val ended = GoalRule(options, 1000, ErrorRecorder(Development(), None))
      val rendering = Renderer.render(plan, RenderControl(2, rule = ended))
      val problem = MissedGoal.problem(ended, rendering)
      for p <- problem do assert(p.help.contains("a larger --spp, or none, allows more"))
      problem.map(_.message)
    val why = "all 1000 samples per pixel are taken"
    // The root of 0.0833 / 1000
    val noisy = missed(RenderGoal(error = Some(1e-4))).get
    assert(noisy.matches(raw"the error is 0\.9\d* %, not 0\.01 %: " + why))
    val early = missed(RenderGoal(time = Some(3600))).get
    assert(early.matches(raw"the rendering ended after [\d.]+ m?s, not .*: " + why))
    val both = missed(RenderGoal(error = Some(1e-4), time = Some(3600))).get
    assert(both.contains("not 0.01 %, and the rendering ended after "))
    val few = GoalRule(RenderGoal(error = Some(0.9)), 2, ErrorRecorder(Development(), None))
    val fewSamples = TinyPlan(width = 4, height = 3, spp = 2)((_, s) => Rgb.gray(s.next1D()))
    val known = MissedGoal.problem(few, Renderer.render(fewSamples, RenderControl(1, rule = few)))
    assert(known.get.message.startsWith("an error is known from 8 samples per pixel on: all 2 "))
    assert(missed(RenderGoal(error = Some(0.5))).isEmpty)
    assert(missed(RenderGoal(time = Some(1e-6))).isEmpty)
