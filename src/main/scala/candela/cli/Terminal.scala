package candela.cli

import java.io.{Console, PrintStream}
import java.nio.file.{Files, Path}

import scala.util.Try

/** Where a run of the program prints, and how it hears of Ctrl-C.
  *
  * @param out           for results
  * @param err           for problems and progress
  * @param isInteractive whether a line on `err` can be redrawn
  * @param columns       how wide text should be
  */
final class Terminal(
    val out: PrintStream,
    val err: PrintStream,
    val isInteractive: Boolean,
    val interrupts: Interrupts,
    val columns: Int = Terminal.UsualColumns
)

object Terminal:

  def ofProcess: Terminal =
    val redraws = isInteractive
    Terminal(System.out, System.err, redraws, Interrupts.fromSignals(System.err, redraws), columns)

  private val UsualColumns = 80

  /** What the shell says, if it does; else what the terminal says, if there is one. */
  private def columns: Int =
    def number(text: String) = text.trim.toIntOption.filter(_ >= 20)
    sys.env.get("COLUMNS").flatMap(number)
      .orElse(Option(System.console()).flatMap(_ => sizeOfTerminal.flatMap(number)))
      .getOrElse(UsualColumns)

  /** Java can't tell; `stty` is wherever terminals are. */
  private def sizeOfTerminal: Option[String] = Try:
    val stty = ProcessBuilder("stty", "size").redirectInput(ProcessBuilder.Redirect.INHERIT).start()
    val text = String(stty.getInputStream.readAllBytes())
    text.trim.split(' ').last
  .toOption

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
