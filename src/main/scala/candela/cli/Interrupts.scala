package candela.cli

import candela.render.Cancellation

import java.io.PrintStream
import java.util.concurrent.CountDownLatch

import scala.util.Try

import sun.misc.{Signal, SignalHandler}

/** What happens on Ctrl-C. */
abstract class Interrupts:

  /** Runs `body`; meanwhile an interrupt is a request to `cancellation`. */
  def during[A](cancellation: Cancellation)(body: => A): A

object Interrupts:

  /** For programs within programs: Ctrl-C is somebody else's business. */
  object Ignored extends Interrupts:
    def during[A](cancellation: Cancellation)(body: => A): A = body

  /** @param isInteractive whether Ctrl-C leaves its `^C` on the line */
  def fromSignals(err: PrintStream, isInteractive: Boolean): Interrupts =
    Signals(err, if isInteractive then "\n" else "")

  /** The first SIGINT cancels, the second quits at once. Another request to end (SIGTERM: a batch
    * system, or sbt that passes a Ctrl-C on) cancels too, and waits until `body` has written its
    * image.
    */
  private final class Signals(err: PrintStream, lineEnd: String) extends Interrupts:
    private val interrupt = Signal("INT")

    def during[A](cancellation: Cancellation)(body: => A): A =
      val ended = CountDownLatch(1)
      val onShutdown = Thread: () =>
        cancellation.request()
        ended.await()
      val onInterrupt: SignalHandler = _ =>
        if cancellation.isRequested then Runtime.getRuntime.halt(ExitCode.Interrupted.number)
        else
          // said first: a rendering may end as soon as it is asked to, and its result is said next
          err.println(s"${lineEnd}stopping; Ctrl-C again quits and writes nothing")
          cancellation.request()
      Runtime.getRuntime.addShutdownHook(onShutdown)
      // Refused if Java was told (-Xrs) to leave signals alone.
      val previous = Try(Signal.handle(interrupt, onInterrupt)).toOption
      try body
      finally
        previous.foreach(Signal.handle(interrupt, _))
        ended.countDown()
        // Refused while the process ends, and then not needed.
        val _ = Try(Runtime.getRuntime.removeShutdownHook(onShutdown))
