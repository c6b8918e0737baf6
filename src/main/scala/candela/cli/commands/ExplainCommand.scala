package candela.cli.commands

import candela.diagnostics.{
  Code, Problem, ProblemEntry, ProblemExample, ProblemGuide, SceneError, Suggest
}
import candela.cli.options.{OptionText, Options}
import candela.cli.terminal.{ExitCode, Report, Terminal, TextTable}

import java.util.Locale

/** `candela explain`: what problems mean. */
final class ExplainCommand(options: Options, terminal: Terminal, report: Report):

  def run(): ExitCode = report.guarded:
    val lines =
      if options.files.isEmpty then list
      else options.files.map(codeOf).distinct.map(explained).reduce((a, b) => a ++ ("" +: b))
    lines.foreach(terminal.out.println(_))
    terminal.out.flush()
    ExitCode.Done

  private def codeOf(word: String): Code = Code.of(word).getOrElse:
    val nearest = Suggest.nearest(word.toUpperCase(Locale.ROOT), Code.values.map(_.word))
    val help = nearest.fold("`candela explain` lists all")(n => s"did you mean `$n`?")
    throw SceneError(Problem.general(
      Code.UnknownEntry,
      s"no problem is called `$word`",
      Some(help)
    ))

  private def list: Vector[String] =
    TextTable(terminal.columns).lines(ProblemGuide.all.map(e => Vector(e.code.word, e.title)))

  private def explained(code: Code): Vector[String] =
    val e = ProblemGuide.of(code)
    def wrapped(text: String) = TextTable.wrap(OptionText.unlinked(text), terminal.columns)
    Vector(s"${e.code.word}: ${e.title}", "") ++ wrapped(e.meaning) ++
      (if e.example.isEmpty then Vector.empty else "" +: ProblemsPage.example(e).map("    " + _)) ++
      ("" +: wrapped(s"Cure: ${e.cure}"))

/** docs/PROBLEMS.md. */
private[cli] object ProblemsPage:

  def lines: Vector[String] =
    Introduction.linesIterator.toVector ++ ProblemGuide.all.flatMap: e =>
      val exampleLines =
        if e.example.isEmpty then Vector.empty
        else Vector("", "```") ++ example(e) ++ Vector("```")
      Vector("", s"## ${e.code.word}: ${e.title}", "", e.meaning) ++ exampleLines ++
        Vector("", s"**Cure**: ${e.cure}")

  def example(e: ProblemEntry): Vector[String] = e.example.toVector.flatMap:
    case ProblemExample.Command(words) => Vector(s"$$ candela $words")
    case ProblemExample.Scene(text) => text.linesIterator.toVector

  private val Introduction: String =
    """# Problems
      |
      |Each error and each warning ends with a number such as `[E0201]`, the same in all versions of
      |Candela. `candela explain E0201` prints its entry. This page has all; it is generated:
      |`./sbt "run describe --problems --outfile docs/PROBLEMS.md"`.""".stripMargin
