package candela.scenefile

import candela.diagnostics.{Code, Problem, Severity}
import scala.collection.mutable

/** Included files from outside of the scene's folder of which no statement has been read yet. They
  * may be none of the scene's author, and no scenes: a mistake in one is told without its text.
  *
  * @param to receives the problems of all files
  */
private[scenefile] final class DoubtfulFiles(to: Problem => Unit):
  private val doubtful, justified = mutable.Set.empty[String]
  private val warnings = mutable.ArrayBuffer.empty[Problem]

  /** Notes that such a file will be read. */
  def raise(file: String): Unit = doubtful += file

  /** Notes that a statement of the file has been read. */
  def dispel(file: String): Unit =
    if doubtful.remove(file) then
      val (own, others) = warnings.toVector.partition(_.pos.exists(_.file == file))
      warnings.clear()
      warnings ++= others
      own.foreach(to)

  /** Whether the file is no scene. */
  def areJustified(file: String): Boolean = justified(file)

  def add(problem: Problem): Unit =
    problem.pos.filter(at => doubtful(at.file)) match
      case None => to(problem)
      case Some(_) if problem.severity == Severity.Warning => warnings += problem
      case Some(at) if justified.add(at.file) =>
        val message = s"can't include `${at.file}`: it is not a scene: line " +
          s"${at.line} is not a statement (not shown: the file is outside the scene's folder)"
        to(Problem.error(Code.NoScene, at.includedFrom.getOrElse(at), message))
      case _ => ()
