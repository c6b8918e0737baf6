package candela.cli

import candela.base.{Problem, SceneError, Suggest}
import candela.build.{Category, Language}
import candela.scenefile.Dialect

import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}

/** `candela describe`: what scene files can say, from the tables that scenes are built by. */
final class DescribeCommand(options: Options, terminal: Terminal, report: Report):
  private val described = Described(options.dialect.fold(Dialect.values.toSet)(Set(_)))
  private val text = ReferenceText(described, terminal.columns)

  def run(): ExitCode = report.guarded:
    val lines =
      if options.markdown then ReferenceMarkdown(described).page else answer(options.files)
    options.outfiles match
      case Vector() =>
        lines.foreach(terminal.out.println)
        terminal.out.flush()
      case files =>
        for f <- files do Files.writeString(Path.of(f), lines.map(_ + "\n").mkString, UTF_8)
    ExitCode.Done

  private def answer(words: Vector[String]): Vector[String] = words match
    case Vector() => text.categories
    case Vector(word) =>
      val categories = Language.categories.filter(isCalled(_, word))
      if categories.nonEmpty then separated(categories.map(text.category))
      else of(Language.categories, word, Language.categories.flatMap(c => c.name +: c.aliases))
    case Vector(category, name) =>
      val categories = Language.categories.filter(isCalled(_, category))
      if categories.isEmpty then
        unknown("category", category, Language.categories.flatMap(c => c.name +: c.aliases))
      else of(categories, name, Vector.empty)
    case _ => throw SceneError(Problem.general("describe takes a category, a type, or both"))

  /** The types of that name. */
  private def of(in: Vector[Category], name: String, others: Vector[String]): Vector[String] =
    val types = in.flatMap(described.types)
    types.filter(_.name.equalsIgnoreCase(name)) match
      case Vector() => unknown(
          if in.size == 1 then in.head.name else "type",
          name,
          types.map(_.name).filter(_.nonEmpty) ++ others
        )
      case found => separated(found.map(text.parameters))

  private def isCalled(c: Category, word: String): Boolean =
    (c.name +: c.aliases).exists(n => n.equalsIgnoreCase(word) || (n + "s").equalsIgnoreCase(word))

  private def separated(texts: Vector[Vector[String]]): Vector[String] =
    texts.reduce((a, b) => a ++ Vector("", "") ++ b)

  private def unknown(kind: String, word: String, known: Vector[String]): Nothing =
    val start = known.find(_.toLowerCase.startsWith(word.toLowerCase))
    val help = Suggest.nearest(word, known).orElse(start).map(k => s"did you mean `$k`?")
    val where = options.dialect.fold("")(d => s" in ${d.toString.toLowerCase}")
    throw SceneError(
      Problem.general(
        s"no ${kind.toLowerCase} is called `$word`$where",
        help.orElse(Some("`candela describe` lists all categories"))
      )
    )
