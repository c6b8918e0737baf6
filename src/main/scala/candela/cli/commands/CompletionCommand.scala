package candela.cli.commands

import candela.diagnostics.{Code, Problem, SceneError, Suggest}
import candela.cli.options.{Completion, Options, Words}
import candela.cli.terminal.{ExitCode, Report, Terminal}

/** `candela completion`: prints what makes a shell complete command lines. */
final class CompletionCommand(options: Options, terminal: Terminal, report: Report):

  def run(): ExitCode = report.guarded:
    val shell = options.files.head
    val lines = Completion.of(shell).getOrElse:
      val shells = s"${Words.shells.init.mkString(", ")} and ${Words.shells.last}"
      val suggestion = Suggest.nearest(shell, Words.shells).map(n => s"did you mean `$n`?")
      throw SceneError(
        Problem.general(
          Code.UnknownEntry,
          s"there is no completion for `$shell`",
          suggestion.orElse(Some(s"known: $shells"))
        )
      )
    lines.foreach(terminal.out.println(_))
    terminal.out.flush()
    ExitCode.Done
