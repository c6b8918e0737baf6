package candela.render

import candela.color.Rgb
import candela.film.Film

import org.scalatest.funsuite.AnyFunSuite

class ProgressSuite extends AnyFunSuite:

  test("the fraction is of the samples, or of the expected time where a goal ends the rendering"):
    val plain = Progress(25, 100, seconds = 2)
    assert(plain.fraction == 0.25)
    def withGoal(left: Option[Double]) = plain.copy(outlook = Outlook(left, hasGoal = true))
    assert(withGoal(None).knownFraction.isEmpty && withGoal(None).fraction == 0)
    assert(withGoal(Some(2)).fraction == 0.5 && withGoal(Some(98)).fraction == 0.25)
    assert(withGoal(None).copy(isOver = true).fraction == 1)

  test("it ends at 1, whatever ends the rendering, unless it is cancelled"):
    def fraction(rule: StoppingRule, cancellation: Cancellation = Cancellation()) =
      var last = Progress(0, 1, 0)
      val listener = RenderListener.onProgress(p => last = p)
      val plan = TinyPlan(width = 8, height = 8, spp = 64)((_, s) => Rgb.gray(s.next1D()))
      val control = RenderControl(1, listener = listener, rule = rule, cancellation = cancellation)
      val _ = Renderer.render(plan, control)
      last.fraction
    val early = new StoppingRule:
      private var samples = 0
      override def frequency = Looks.Waves
      override def passed(pass: Pass, film: Film): Unit = samples = pass.samples
      override def expectedEnd = Some(ExpectedEnd(None, isByError = true, None))
      override def stopsAfterPass = samples >= 8
    assert(fraction(StoppingRule.Never) == 1 && fraction(early) == 1)
    val cancelled = Cancellation()
    cancelled.request()
    assert(fraction(StoppingRule.Never, cancelled) < 1)
