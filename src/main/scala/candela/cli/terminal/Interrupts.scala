package candela.cli.terminal

import candela.io.NextFile
import candela.render.Cancellation

import java.io.{InputStream, PrintStream}
import java.util.concurrent.CountDownLatch
import java.util.concurrent.atomic.AtomicLong

import scala.util.Try

import sun.misc.{Signal, SignalHandler}

/** Handles Ctrl-C. */
abstract class Interrupts:

  /** Runs `body`; an interrupt meanwhile requests `cancellation`. */
  def during[A](cancellation: Cancellation)(body: => A): A

  /** @throws SceneError if the time of the run is over */
  def checkTime(): Unit = ()

  /** Ends the process at once, if it is ours. */
  def quit(code: ExitCode): Unit = ()

  /** From now on, except [[during]] a rendering, an interrupt quits at once. */
  def quitting(): Unit = ()

object Interrupts:

  /** For embedding: the host program handles Ctrl-C. */
  object Ignored extends Interrupts:
    def during[A](cancellation: Cancellation)(body: => A): A = body

  /** Quits when `input` ends: its other end is held by the program that started this one, which
    * may be killed and tell nobody.
    */
  def quitAfter(input: InputStream, interrupts: Interrupts): Unit =
    listening:
      val _ = Try(while input.read() >= 0 do ())
      interrupts.quit(ExitCode.Interrupted)

  /** Runs `body`, which reads what the program says that started this one, while commands run. */
  def listening(body: => Unit): Unit =
    val reader = Thread(() => body)
    reader.setDaemon(true)
    reader.setName("parent")
    reader.start()

  /** @param isInteractive whether the terminal echoes `^C` on the line
    * @param signal        of Ctrl-C
    */
  def fromSignals(err: PrintStream, isInteractive: Boolean, signal: String = "INT"): Interrupts =
    Signals(err, isInteractive, signal)

  /** The first SIGINT cancels, the second quits at once, unless it is the same one: `timeout`
    * signals the process and then its group. SIGTERM (from a batch system, or from sbt
    * passing on a Ctrl-C) cancels too, and waits until `body` has written its image.
    */
  private final class Signals(err: PrintStream, echoes: Boolean, signal: String)
      extends Interrupts:
    private val interrupt = Signal(signal)

    /** A keyboard repeats a key after 30 ms at the earliest. */
    private val SameInterruptNanos = 20_000_000L

    override def quitting(): Unit =
      val onInterrupt: SignalHandler = _ =>
        if echoes then err.println()
        err.println("interrupted")
        err.flush()
        quit(ExitCode.Interrupted)
      val _ = Try(Signal.handle(interrupt, onInterrupt))

    /** Without anything that goes on meanwhile and might fail, and leaves nothing half-written. */
    override def quit(code: ExitCode): Unit =
      NextFile.giveUp(Runtime.getRuntime.halt(code.number))

    def during[A](cancellation: Cancellation)(body: => A): A =
      val ended = CountDownLatch(1)
      val onShutdown = Thread: () =>
        cancellation.request()
        ended.await()
      val first = AtomicLong(Long.MinValue)
      val onInterrupt: SignalHandler = _ =>
        val time = System.nanoTime
        if cancellation.isRequested then
          if time - first.get > SameInterruptNanos then quit(ExitCode.Interrupted)
        else
          first.set(time)
          // Printed first, because a cancelled rendering may end, and print its result, at once.
          if echoes then err.println()
          err.println("stopping; Ctrl-C again quits and writes nothing")
          cancellation.request()
      // During shutdown it fails: the interrupt came before.
      if Try(Runtime.getRuntime.addShutdownHook(onShutdown)).isFailure then cancellation.request()
      // Fails if Java runs with -Xrs, which reserves signals.
      val previous = Try(Signal.handle(interrupt, onInterrupt)).toOption
      try body
      finally
        previous.foreach(Signal.handle(interrupt, _))
        ended.countDown()
        // Fails during shutdown, when it is not needed.
        val _ = Try(Runtime.getRuntime.removeShutdownHook(onShutdown))
