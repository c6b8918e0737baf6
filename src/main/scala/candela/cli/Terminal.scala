package candela.cli

import java.io.{Console, PrintStream}
import java.nio.file.{Files, Path}

import scala.util.Try

/** Where a run of the program prints, and how it hears of Ctrl-C.
  *
  * @param out           for results
  * @param err           for problems and progress
  * @param isInteractive whether a line on `err` can be redrawn
  */
final class Terminal(
    val out: PrintStream,
    val err: PrintStream,
    val isInteractive: Boolean,
    val interrupts: Interrupts
)

object Terminal:

  def ofProcess: Terminal =
    val redraws = isInteractive
    Terminal(System.out, System.err, redraws, Interrupts.fromSignals(System.err, redraws))

  private def isInteractive: Boolean =
    val attached = Option(System.console()).exists: console =>
      // From JDK 22 on there may be a console without a terminal, and a method that says so.
      val isTerminal = Try(classOf[Console].getMethod("isTerminal").invoke(console))
      isTerminal.fold(_ => true, java.lang.Boolean.TRUE.equals)
    val isDumb = sys.env.get("TERM").contains("dumb")
    attached && !isDumb && !errIsRedirected

  /** The console is about input and output alone; where there is /proc, it tells about errors. */
  private def errIsRedirected: Boolean =
    Try(Files.readSymbolicLink(Path.of("/proc/self/fd/2")))
      .fold(_ => false, target => !target.startsWith("/dev"))
