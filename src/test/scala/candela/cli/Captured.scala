package candela.cli

import candela.cli.terminal.{Interrupts, Terminal}

import java.io.{ByteArrayOutputStream, PrintStream}
import java.nio.charset.StandardCharsets.UTF_8

/** A terminal that remembers what was printed. */
final class Captured(
    isInteractive: Boolean = false,
    interrupts: Interrupts = Interrupts.Ignored,
    environment: Map[String, String] = Map.empty
):
  private val outBytes = ByteArrayOutputStream()
  private val errBytes = ByteArrayOutputStream()

  val terminal: Terminal = Terminal(
    PrintStream(outBytes, true, UTF_8),
    PrintStream(errBytes, true, UTF_8),
    isInteractive,
    interrupts,
    environment = environment
  )

  def out: String = outBytes.toString(UTF_8)
  def err: String = errBytes.toString(UTF_8)

object Captured:
  /** Runs the program; returns its exit code and what it printed. */
  def run(args: String*): (Int, Captured) =
    val captured = Captured()
    (Main.run(args, captured.terminal), captured)
