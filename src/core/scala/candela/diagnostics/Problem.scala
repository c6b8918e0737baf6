package candela.diagnostics

import scala.math.Ordering.Implicits.seqOrdering

/** A position in a text file; lines and columns count from 1. Line 0: a place that `file` alone
  * tells, such as `model.glb#/meshes/0`. `includedFrom` is the statement that included the file,
  * unless it is the main scene file.
  */
final case class SourcePos(
    file: String,
    line: Int,
    column: Int,
    includedFrom: Option[SourcePos] = None
):
  override def toString: String = if line == 0 then file else s"$file:$line:$column"

  /** None if it is nowhere. */
  private[candela] def toOption: Option[SourcePos] = Option.when(this != SourcePos.Nowhere)(this)

  /** Lines and columns, from the main file inwards. */
  private[candela] def path: List[(Int, Int)] =
    includedFrom.fold(Nil)(_.path) :+ (line, column)

object SourcePos:
  /** Of what no file contains. */
  val Nowhere: SourcePos = SourcePos("", 0, 0)

enum Severity:
  case Warning, Error

/** A problem with the user's input.
  *
  * @param code    what it is: its number, which [[ProblemGuide]] explains
  * @param message expected and found, on one line
  * @param help    the cure, e.g. what to write instead
  * @param excerpt text of the line at `pos`, without its line end
  * @param standIn the placeholder for a missing item: already in use if a warning; if an error,
  *   used under --keep-going
  */
final case class Problem(
    code: Code,
    severity: Severity,
    pos: Option[SourcePos],
    message: String,
    help: Option[String] = None,
    excerpt: Option[String] = None,
    standIn: Option[String] = None
):
  /** The same, with help on one line. */
  def withHelp(help: Option[String]): Problem = copy(help = help.map(Problem.line))

object Problem:

  /** Problems in the order in which the scene is read; those without a position come last. */
  def byPlace(problems: Vector[Problem]): Vector[Problem] =
    val (placed, others) = problems.partition(_.pos.nonEmpty)
    placed.sortBy(_.pos.map(_.path)) ++ others

  def error(code: Code, at: SourcePos, message: String, help: Option[String] = None): Problem =
    Problem(code, Severity.Error, at.toOption, line(message), help.map(line))

  /** An error at a place, if it has one. */
  def error(code: Code, at: Option[SourcePos], message: String, help: Option[String]): Problem =
    at.fold(general(code, message, help))(error(code, _, message, help))

  def warning(code: Code, at: SourcePos, message: String, help: Option[String] = None): Problem =
    Problem(code, Severity.Warning, at.toOption, line(message), help.map(line))

  /** `text` as a single printable line, whatever names it contains: no control characters, and at
    * most a few terminal lines long.
    */
  private def line(text: String): String =
    val visible = Visible.line(text)
    if visible.length <= Longest then visible
    else
      val (head, tail) = (visible.take(Longest - 100), visible.takeRight(90))
      // Between words, unless they are long
      val (end, begin) = (head.lastIndexOf(' '), tail.indexOf(' '))
      val first = if head.length - end <= LongestWord then head.take(end) else head
      s"$first … ${if begin < LongestWord then tail.drop(begin + 1) else tail}"

  private inline val Longest = 500
  private inline val LongestWord = 40

  /** Problem about an item that the scene names but that doesn't exist.
    *
    * @param standIn the placeholder used, or the consequence: "skipped"
    * @param keepGoing if true, a warning; otherwise an error
    */
  def missing(
      code: Code,
      at: SourcePos,
      message: String,
      standIn: String,
      keepGoing: Boolean,
      help: Option[String] = None
  ): Problem =
    val (severity, text) =
      if keepGoing then (Severity.Warning, s"$message; $standIn") else (Severity.Error, message)
    Problem(code, severity, at.toOption, line(text), help.map(line), standIn = Some(standIn))

  /** An error without a position in a scene file, e.g. an output folder that can't be written. */
  def general(code: Code, message: String, help: Option[String] = None): Problem =
    Problem(code, Severity.Error, None, message, help)

/** Thrown where reading can't continue; caught only in `cli`. Not a bug, so it has no stack trace.
  */
final class SceneError(val problems: Vector[Problem])
    extends RuntimeException(problems.map(_.message).mkString("; "), null, false, false):
  def this(problem: Problem) = this(Vector(problem))
