package candela.cli

import candela.color.Rgb
import candela.render.{Cancellation, Renderer, TinyPlan}

import org.scalatest.funsuite.AnyFunSuite

import sun.misc.Signal

class InterruptsSuite extends AnyFunSuite:

  test("Ctrl-C ends a rendering that would take years, and says how to quit at once"):
    val captured = Captured()
    val cancellation = Cancellation()
    @volatile var pressed = false
    val plan = TinyPlan(spp = 1_000_000_000): (where, _) =>
      if where.sample == 2 && !pressed then
        pressed = true
        Signal.raise(Signal("INT"))
      Rgb.White
    val rendering = Interrupts.fromSignals(captured.terminal.err, false).during(cancellation):
      Renderer.render(plan, threads = 1, cancellation)
    assert(cancellation.isRequested)
    assert(!rendering.isComplete)
    assert(rendering.samplesDone >= 2)
    assert(captured.err == "stopping; Ctrl-C again quits without an image\n")

  test("without Ctrl-C nothing is cancelled, and the result is passed on"):
    val cancellation = Cancellation()
    assert(Interrupts.fromSignals(System.err, false).during(cancellation)(42) == 42)
    assert(!cancellation.isRequested)

  test("what fails meanwhile is passed on"):
    val interrupts = Interrupts.fromSignals(System.err, false)
    val failure = intercept[IllegalStateException]:
      interrupts.during(Cancellation())(throw IllegalStateException("planted"))
    assert(failure.getMessage == "planted")
