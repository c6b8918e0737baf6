package candela.cli

import java.io.PrintStream

/** The program. The only place that exits. */
object Main:

  def main(args: Array[String]): Unit =
    val code = run(args.toVector, Terminal.ofProcess)
    System.out.flush()
    System.err.flush()
    System.exit(code)

  /** Runs a command line within another program; returns the exit code. */
  def run(args: Seq[String], out: PrintStream, err: PrintStream): Int =
    run(args, Terminal(out, err, isInteractive = false, Interrupts.Ignored))

  private[cli] def run(
      args: Seq[String],
      terminal: Terminal,
      loader: SceneLoader = SceneLoader.FromFile
  ): Int =
    val code = CommandLine.parse(args) match
      case Left(answer) =>
        terminal.out.print(answer.out)
        terminal.err.print(answer.err)
        answer.code
      case Right(options) =>
        val canKeepGoing = OptionTable.names(options.command.word).contains("keep-going")
        val report = Report(terminal.err, options.quiet, options.verbose, canKeepGoing)
        options.command match
          case Command.Render => RenderCommand(options, terminal, report, loader).run()
          case Command.Check => CheckCommand(options, terminal, report, loader).run()
          case Command.Compare => CompareCommand(options, terminal, report).run()
          case Command.Bench => BenchCommand(options, terminal, report).run()
          case Command.Describe => DescribeCommand(options, terminal, report).run()
          case Command.Convert => ConvertCommand(options, terminal, report).run()
    code.number

/** How a run ended, from best to worst; `number` is what the shell sees. */
enum ExitCode(val number: Int):
  case Done extends ExitCode(0)

  /** A scene, an image or a folder is not as it should be; or a comparison is above its limit. */
  case BadInput extends ExitCode(1)

  /** The command line is not understood. */
  case BadUsage extends ExitCode(2)

  /** Candela itself is at fault. */
  case Bug extends ExitCode(3)

  /** Ended by Ctrl-C: 128 and the number of SIGINT, as shells have it. */
  case Interrupted extends ExitCode(130)

  def worseOf(other: ExitCode): ExitCode = if other.ordinal > ordinal then other else this
