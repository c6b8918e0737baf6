package candela.cli.terminal

import candela.cli.Captured
import candela.color.Rgb
import candela.render.{Cancellation, Renderer, TinyPlan}

import org.scalatest.funsuite.AnyFunSuite

import sun.misc.{Signal, SignalHandler}

class InterruptsSuite extends AnyFunSuite:

  /** Started in the background of a script, a JVM ignores SIGINT for good: nothing to test then. */
  private def isInterruptIgnored: Boolean =
    val interrupt = Signal("INT")
    val previous = Signal.handle(interrupt, _ => ())
    if previous != SignalHandler.SIG_IGN then
      val _ = Signal.handle(interrupt, previous)
    previous == SignalHandler.SIG_IGN

  test("Ctrl-C ends a rendering that would take years, and says how to quit at once"):
    assume(!isInterruptIgnored, "SIGINT is ignored in this process")
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
    assert(captured.err == "stopping; Ctrl-C again quits and writes nothing\n")

  test("without Ctrl-C nothing is cancelled, and the result is passed on"):
    val cancellation = Cancellation()
    assert(Interrupts.fromSignals(System.err, false).during(cancellation)(42) == 42)
    assert(!cancellation.isRequested)

  test("what fails meanwhile is passed on"):
    val interrupts = Interrupts.fromSignals(System.err, false)
    val failure = intercept[IllegalStateException]:
      interrupts.during(Cancellation())(throw IllegalStateException("planted"))
    assert(failure.getMessage == "planted")
