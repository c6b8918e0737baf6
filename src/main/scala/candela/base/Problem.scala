package candela.base

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

enum Severity:
  case Warning, Error

/** Something that a person should know about their input.
  *
  * @param message what was expected and what was found, on one line
  * @param help    what to write instead
  * @param excerpt the text of the line at `at`, without its line end
  */
final case class Problem(
    severity: Severity,
    at: Option[SourcePos],
    message: String,
    help: Option[String] = None,
    excerpt: Option[String] = None
)

object Problem:
  def error(at: SourcePos, message: String, help: Option[String] = None): Problem =
    Problem(Severity.Error, Some(at), message, help)

  def warning(at: SourcePos, message: String, help: Option[String] = None): Problem =
    Problem(Severity.Warning, Some(at), message, help)

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
