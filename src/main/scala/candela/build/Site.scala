package candela.build

import scala.collection.mutable

import candela.base.{Problem, Severity, SourcePos}
import candela.math.Transform
import candela.scenefile.{Declaration, Dialect}

/** Gathers what is wrong with a description, so that one run can name it all. */
final class Findings:
  private val all = mutable.LinkedHashSet.empty[Problem]

  def warn(at: SourcePos, message: String, help: Option[String] = None): Unit =
    all += Problem.warning(at, message, help)

  def error(at: SourcePos, message: String, help: Option[String] = None): Unit =
    all += Problem.error(at, message, help)

  def result: Vector[Problem] = all.toVector
  def hasErrors: Boolean = all.exists(_.severity == Severity.Error)

/** Where a recipe is being followed: the statement, the dialect, and what the scene has so far.
  *
  * @param toWorld the transform at the statement, for recipes that need to know it
  */
final class Site(
    val declaration: Declaration,
    val dialect: Dialect,
    val resources: Resources,
    val problems: Findings,
    val toWorld: Transform = Transform.Identity
):
  def in(other: Dialect): Site = Site(declaration, other, resources, problems, toWorld)

  def warn(message: String, help: Option[String] = None): Unit =
    problems.warn(declaration.at, message, help)
  def error(message: String, help: Option[String] = None): Unit =
    problems.error(declaration.at, message, help)
