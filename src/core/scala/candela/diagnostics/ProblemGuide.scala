package candela.diagnostics

import java.nio.charset.StandardCharsets.UTF_8

import scala.util.Using

/** Meaning and cure of a kind of problem.
  *
  * @param title   in one line
  * @param meaning sentences of Markdown
  * @param example what has the problem, if one is short enough
  * @param cure    sentences of Markdown
  */
final case class ProblemEntry(
    code: Code,
    title: String,
    meaning: String,
    example: Option[ProblemExample],
    cure: String
)

/** An example that causes a problem. */
enum ProblemExample:
  /** A command line, without `candela` before it. */
  case Command(words: String)

  /** The text of a scene of pbrt. */
  case Scene(text: String)

/** Explanations of all problems, from the resource `problems.md`. */
object ProblemGuide:

  def of(code: Code): ProblemEntry = byCode(code)

  def all: Vector[ProblemEntry] = Code.values.toVector.map(of)

  private lazy val byCode: Map[Code, ProblemEntry] =
    val input = getClass.getResourceAsStream("/candela/problems/problems.md")
    val text = Using.resource(input)(i => String(i.readAllBytes(), UTF_8))
    text.split("(?m)^# ").toVector.map(_.trim).filter(_.nonEmpty).map(entry).map(e => e.code -> e)
      .toMap

  private def entry(text: String): ProblemEntry =
    val lines = text.linesIterator.toVector
    val (name, title) = lines.head.span(_ != ':')
    val (before, cure) = lines.tail.span(!_.startsWith(Cure))
    val example = before.drop(1) match
      case Vector() => None
      case s"$$ candela $words" +: _ => Some(ProblemExample.Command(words))
      case "Scene:" +: scene => Some(ProblemExample.Scene(scene.mkString("\n")))
      case other => throw IllegalArgumentException(s"$name: ${other.head}")
    ProblemEntry(
      Code.valueOf(name),
      title.drop(1).trim.capitalize,
      before.head,
      example,
      cure.mkString(" ").stripPrefix(Cure).trim
    )

  private val Cure = "Cure:"
