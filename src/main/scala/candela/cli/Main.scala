package candela.cli

import candela.diagnostics.{Code, Problem, Severity}
import candela.cli.commands.{
  AverageCommand, CheckCommand, ClusterCommand, CompareCommand, CompletionCommand, ConvertCommand,
  DescribeCommand, ExplainCommand, ImageCommand, InfoCommand, MergeCommand, MoveCommand,
  PreviewCommand, ReferenceCommand, RenderCommand, ResumeCommand, ViewCommand
}
import candela.cli.options.{Command, CommandLine, CommandService, CommandTable, Options}
import candela.cli.terminal.{ExitCode, Interrupts, ProblemText, Report, Terminal}
import candela.image.Natives
import candela.job.SceneLoader

import java.io.{IOException, PrintStream}

import scala.util.Try

/** Entry point; the only place that exits. */
object Main:

  def main(args: Array[String]): Unit =
    JavaWarnings.hush()
    Natives.quieten()
    // Before the first class of AWT loads: a renderer must not open a display
    if sys.props.get(Headless).isEmpty then
      val _ = System.setProperty(Headless, "true")
    val code =
      try
        val terminal = Terminal.ofProcess
        val readsInput = args.headOption.contains(Command.Session.word)
        if terminal.belongsToProgram && !readsInput then
          Interrupts.quitAfter(System.in, terminal.interrupts)
        run(args.toVector, terminal)
      catch
        case _: OutOfMemoryError =>
          // So early that nothing else can tell it
          System.err.println(NoHeap)
          1
    System.err.flush()
    System.exit(code)

  private val Headless = "java.awt.headless"

  private val NoHeap =
    "error: out of memory: Java's heap is too small to begin; raise the limit, e.g. by -Xmx8g"

  /** Runs a command line within another program; returns the exit code. */
  def run(args: Seq[String], out: PrintStream, err: PrintStream): Int =
    run(args, Terminal(out, err, isInteractive = false, Interrupts.Ignored))

  private[candela] def run(
      args: Seq[String],
      terminal: Terminal,
      loader: SceneLoader = SceneLoader.FromFile
  ): Int =
    val code = CommandLine.parse(args, terminal.columns) match
      case Left(answer) =>
        answer.lines.foreach(terminal.out.println(_))
        answer.problems.foreach(ProblemText.print(_, terminal.err, terminal.hasColor))
        answer.code
      case Right(options) => TimeLimit.during(options, terminal)(execute(_, _, loader))
    terminal.failure.fold(code)(reportFailure(_, terminal).worseOf(code)).number

  private def execute(options: Options, terminal: Terminal, loader: SceneLoader): ExitCode =
    val optionNames = CommandTable.of(options.command).names
    val report = Report(
      terminal.err,
      options.quiet,
      options.verbose,
      optionNames.contains("keep-going"),
      terminal.hasColor,
      optionNames.contains("verbose")
    )
    if !options.quiet then
      for note <- options.notes do
        val warning = Problem(Code.IdleOption, Severity.Warning, None, note)
        ProblemText.print(warning, terminal.err, terminal.hasColor)
    // Those have children, or shards, to end
    val hasChildren = options.command.module.isDefined
    val isAlone = !hasChildren && options.cluster.master.isEmpty
    if isAlone then terminal.interrupts.quitting()
    options.command match
      case Command.Render if options.cluster.master.isDefined =>
        ClusterCommand(options, terminal, report, loader).run()
      case Command.Render => RenderCommand(options, terminal, report, loader).run()
      case Command.Resume => ResumeCommand(options, terminal, report, loader).run()
      case Command.Merge => MergeCommand(options, terminal, report, loader).run()
      case Command.Check => CheckCommand(options, terminal, report, loader).run()
      case Command.Reference => ReferenceCommand(options, terminal, report, loader).run()
      case Command.Compare => CompareCommand(options, terminal, report).run()
      case Command.Describe => DescribeCommand(options, terminal, report).run()
      case Command.Move => MoveCommand(options, terminal, report, loader).run()
      case Command.Preview => PreviewCommand(options, terminal, report, loader).run()
      case Command.View => ViewCommand(options, terminal, report).run()
      case Command.Image => ImageCommand(options, terminal, report).run()
      case Command.Average => AverageCommand(options, terminal, report).run()
      case Command.Info => InfoCommand(options, terminal, report).run()
      case Command.Convert => ConvertCommand(options, terminal, report).run()
      case Command.Explain => ExplainCommand(options, terminal, report).run()
      case Command.Completion => CompletionCommand(options, terminal, report).run()
      case Command.Session => Session(System.in, terminal, loader).run()
      case Command.Bench | Command.Robustness =>
        CommandService.of(options.command).run(options, terminal, report)

  /** Nobody wants to hear of output that its reader did not want, such as `head`. */
  private def reportFailure(failure: IOException, terminal: Terminal): ExitCode =
    if failure.getMessage != "Broken pipe" then
      val message = s"can't write to standard output: ${failure.getMessage}"
      ProblemText.print(Problem.general(Code.Unwritable, message), terminal.err, terminal.hasColor)
    ExitCode.BadInput

/** What Java prints about the program's own code, which its user can't change. */
private object JavaWarnings:

  /** JDK 24 and later warn once that Scala's lazy values use `sun.misc.Unsafe`. The launcher's
    * option against it has no equivalent in a manifest: for `java -jar`, it counts as given.
    */
  def hush(): Unit =
    val _ = Try:
      val isGiven = classOf[sun.misc.Unsafe].getDeclaredField("memoryAccessWarned")
      isGiven.setAccessible(true)
      isGiven.setBoolean(null, true)
