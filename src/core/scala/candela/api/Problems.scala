package candela.api

import candela.diagnostics.{Code, SceneError}
import candela.image.{ImageError, MissingNatives}

import scala.jdk.CollectionConverters.*

/** Problems of the core, for callers. */
private[api] object Problems:

  def ofCore(found: Vector[candela.diagnostics.Problem]): java.util.List[Problem] =
    java.util.List.copyOf(found.map(Problem(_)).asJava)

  /** Runs `body` and turns its errors into a [[SceneException]]. */
  def thrown[A](body: => A): A =
    try body
    catch
      case e: SceneError => throw SceneException(e.problems)
      case e: ImageError => fail(e.code, e.getMessage)
      case e: MissingNatives => fail(Code.MissingLibrary, e.getMessage, Some(e.help))

  def fail(code: Code, message: String, help: Option[String] = None): Nothing =
    throw SceneException(Vector(candela.diagnostics.Problem.general(code, message, help)))
