package candela.base

import scala.math.Ordering.Implicits.seqOrdering

/** A place in a text file; lines and columns count from 1. `includedFrom` is the statement that
  * brought this file in, if it is not the scene file itself.
  */
final case class SourcePos(
    file: String,
    line: Int,
    column: Int,
    includedFrom: Option[SourcePos] = None
):
  override def toString: String = s"$file:$line:$column"

  /** Lines and columns, from the main file's inwards. */
  private[base] def path: List[(Int, Int)] =
    includedFrom.fold(Nil)(_.path) :+ (line, column)

enum Severity:
  case Warning, Error

/** Something that a person should know about their input.
  *
  * @param message what was expected and what was found, on one line
  * @param help    what to write instead
  * @param excerpt the text of the line at `at`, without its line end
  * @param standIn something is missing, and this takes its place: of a warning, it has done so; of
  *                an error, it would if the user had asked to keep going
  */
final case class Problem(
    severity: Severity,
    at: Option[SourcePos],
    message: String,
    help: Option[String] = None,
    excerpt: Option[String] = None,
    standIn: Option[String] = None
)

object Problem:

  /** In the order in which the scene is read; what has no place comes last. */
  def byPlace(problems: Vector[Problem]): Vector[Problem] =
    val (placed, others) = problems.partition(_.at.nonEmpty)
    placed.sortBy(_.at.map(_.path)) ++ others

  def error(at: SourcePos, message: String, help: Option[String] = None): Problem =
    Problem(Severity.Error, Some(at), line(message), help.map(line))

  def warning(at: SourcePos, message: String, help: Option[String] = None): Problem =
    Problem(Severity.Warning, Some(at), line(message), help.map(line))

  /** One line that a terminal can show, whatever names the file has: no control characters, and not
    * longer than a few lines of a terminal.
    */
  private def line(text: String): String =
    val shown = text.map(c => if c.isControl then '?' else c)
    if shown.length <= Longest then shown
    else s"${shown.take(Longest - 100)} … ${shown.takeRight(90)}"

  private inline val Longest = 500

  /** Something that the scene names is not there.
    *
    * @param standIn  what takes its place: "it is left out"
    * @param keepGoing let it; otherwise it is an error
    */
  def missing(
      at: SourcePos,
      message: String,
      standIn: String,
      keepGoing: Boolean,
      help: Option[String] = None
  ): Problem =
    val (severity, text) =
      if keepGoing then (Severity.Warning, s"$message; $standIn") else (Severity.Error, message)
    Problem(severity, Some(at), line(text), help.map(line), standIn = Some(standIn))

  /** An error that belongs to no place in a scene file, e.g. an output folder that can't be
    * written.
    */
  def general(message: String, help: Option[String] = None): Problem =
    Problem(Severity.Error, None, message, help)

/** Thrown where reading cannot go on; caught once, in `cli`. It is no bug, so it has no stack
  * trace.
  */
final class SceneError(val problems: Vector[Problem])
    extends RuntimeException(problems.map(_.message).mkString("; "), null, false, false):
  def this(problem: Problem) = this(Vector(problem))
