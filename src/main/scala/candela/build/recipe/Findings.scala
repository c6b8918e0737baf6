package candela.build.recipe

import scala.collection.mutable

import candela.base.{Problem, SceneError, Severity, SourcePos}
import candela.scenefile.{Excerpts, NameKind}

/** Gathers what is wrong with a description, so that one run can name it all.
  *
  * @param keepGoing what is missing is replaced, with a warning
  * @param lost      the names that statements which could not be read may have made: that others
  *                  use them is no error of its own
  * @param earlier   errors that were found already
  */
final class Findings(
    keepGoing: Boolean = false,
    lost: Set[NameKind] = Set.empty,
    earlier: Vector[Problem] = Vector.empty
):
  private val all = mutable.LinkedHashSet.from(earlier)
  private var errors = earlier.count(_.severity == Severity.Error)

  private def add(problem: Problem): Unit =
    if all.add(problem) && problem.severity == Severity.Error then errors += 1

  def warn(at: SourcePos, message: String, help: Option[String] = None): Unit =
    add(Problem.warning(at, message, help))

  def error(at: SourcePos, message: String, help: Option[String] = None): Unit =
    add(Problem.error(at, message, help))

  /** Something that the scene asks for is not there: an error, or a warning that says what takes
    * its place.
    */
  def missing(
      at: SourcePos,
      message: String,
      standIn: String,
      help: Option[String] = None
  ): Unit = add(Problem.missing(at, message, standIn, keepGoing, help))

  /** Likewise for a name that no statement made. */
  def unnamed(
      kind: NameKind,
      at: SourcePos,
      message: String,
      standIn: String,
      help: Option[String] = None
  ): Unit = if !lost(kind) then missing(at, message, standIn, help)

  def result: Vector[Problem] = Excerpts.fill(all.toVector)
  def hasErrors: Boolean = errors > 0

  /** Goes no further than errors allow: after them a scene would be built in vain.
    *
    * @throws SceneError with everything that was found
    */
  def stopAtErrors(): Unit = if hasErrors then throw SceneError(Problem.byPlace(result))
