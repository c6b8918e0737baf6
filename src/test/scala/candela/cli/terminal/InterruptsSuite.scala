package candela.cli.terminal

import candela.cli.Captured
import candela.color.Rgb
import candela.render.{RenderControl, Cancellation, Renderer, TinyPlan}

import org.scalatest.funsuite.AnyFunSuite

import sun.misc.{Signal, SignalHandler}

class InterruptsSuite extends AnyFunSuite:

  /** Started in the background of a script, such as that of sbt's server, a JVM ignores SIGINT for
    * good. Another signal, which ends nothing by itself, then takes its place.
    */
  private def name: String =
    val interrupt = Signal("INT")
    val previous = Signal.handle(interrupt, _ => ())
    if previous == SignalHandler.SIG_IGN then "WINCH"
    else
      val _ = Signal.handle(interrupt, previous)
      "INT"

  test("Ctrl-C ends a rendering that would take years, and says how to quit at once"):
    val name = this.name
    val captured = Captured()
    val cancellation = Cancellation()
    @volatile var pressed = false
    val plan = TinyPlan(spp = 1_000_000_000): (where, _) =>
      if where.sample == 2 && !pressed then
        pressed = true
        Signal.raise(Signal(name))
      Rgb.White
    val rendering = Interrupts.fromSignals(captured.terminal.err, false, name).during(cancellation):
      Renderer.render(plan, RenderControl(threads = 1, cancellation))
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
