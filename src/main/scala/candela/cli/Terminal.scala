package candela.cli

import java.io.{Console, PrintStream}
import java.nio.file.{Files, Path}

import scala.util.Try

/** Output streams of a run, and its interrupts.
  *
  * @param out results
  * @param err problems and progress
  * @param isInteractive whether a line on `err` can be redrawn
  * @param columns text width, in characters
  * @param environment variables of the process
  */
final class Terminal(
    val out: PrintStream,
    val err: PrintStream,
    val isInteractive: Boolean,
    val interrupts: Interrupts,
    val columns: Int = Terminal.UsualColumns,
    val environment: Map[String, String] = Map.empty
):
  /** Whether `err` shows colours. Source: "NO_COLOR", no-color.org. */
  def hasColor: Boolean = isInteractive && environment.getOrElse("NO_COLOR", "").isEmpty

object Terminal:

  def ofProcess: Terminal =
    val redraws = isInteractive
    val interrupts = Interrupts.fromSignals(System.err, redraws)
    Terminal(System.out, System.err, redraws, interrupts, columns, sys.env)

  private val UsualColumns = 80

  /** Width from the shell's COLUMNS, else from the terminal, else the usual one. */
  private def columns: Int =
    def number(text: String) = text.trim.toIntOption.filter(_ >= 20)
    sys.env.get("COLUMNS").flatMap(number)
      .orElse(Option(System.console()).flatMap(_ => sizeOfTerminal.flatMap(number)))
      .getOrElse(UsualColumns)

  /** Java has no API for the terminal size; `stty` exists wherever terminals do. */
  private def sizeOfTerminal: Option[String] = Try:
    val stty = ProcessBuilder("stty", "size").redirectInput(ProcessBuilder.Redirect.INHERIT).start()
    val text = String(stty.getInputStream.readAllBytes())
    text.trim.split(' ').last
  .toOption

  private def isInteractive: Boolean =
    val attached = Option(System.console()).exists: console =>
      // Since JDK 22 a console may exist without a terminal; `isTerminal` tells them apart.
      val isTerminal = Try(classOf[Console].getMethod("isTerminal").invoke(console))
      isTerminal.fold(_ => true, java.lang.Boolean.TRUE.equals)
    val isDumb = sys.env.get("TERM").contains("dumb")
    attached && !isDumb && !errIsRedirected

  /** System.console ignores stderr; /proc, where it exists, has its target. */
  private def errIsRedirected: Boolean =
    Try(Files.readSymbolicLink(Path.of("/proc/self/fd/2")))
      .fold(_ => false, target => !target.startsWith("/dev"))
