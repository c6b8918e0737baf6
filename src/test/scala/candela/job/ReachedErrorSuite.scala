package candela.job

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.render.{RenderControl, Renderer, TinyPlan}

class ReachedErrorSuite extends AnyFunSuite:
  /** The error after so many samples, uniform from 0 to 1. */
  private def error(samples: Int): Option[Double] =
    val plan = TinyPlan(32, 32, samples): (_, sampler) =>
      val x = sampler.next1D()
      Rgb(x, x, x)
    val reached = ReachedError(plan.development, samples)
    val rendering = Renderer.render(plan, RenderControl(1, listener = reached))
    reached.errorAt(rendering.samplesDone)

  test("the error of a number of samples is told"):
    // The deviation of a uniform number is the root of 1/12, of a mean of 1/2
    val expected = Math.sqrt(1.0 / 12 / 64) / 0.51
    assert(error(64).exists(e => Math.abs(e / expected - 1) < 0.1), error(64))

  test("few samples say too little"):
    assert(error(2).isEmpty)
    // So none is looked for
    val plan = TinyPlan(2, 2, 3)((_, _) => Rgb(1, 1, 1))
    assert(ReachedError.of(plan.development, 3).isEmpty)
    assert(ReachedError.of(plan.development, 4).nonEmpty)

  test("looks take a hundredth of the time that the rendering is expected to take, at most"):
    assert(!ReachedError.takesLong(0.3, whole = 31))
    assert(ReachedError.takesLong(0.3, whole = 29))
    // A short one does not mind
    assert(!ReachedError.takesLong(0.19, whole = 1))
