package candela.build.recipe

import candela.math.Transform
import candela.scenefile.{Declaration, Dialect}

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

  /** The statement asks for what is not there. */
  def missing(message: String, standIn: String, help: Option[String] = None): Unit =
    problems.missing(declaration.at, message, standIn, help)
