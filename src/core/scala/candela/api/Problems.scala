package candela.api

import candela.diagnostics.{Code, SceneError}
import candela.image.{ImageError, MissingNatives}

import java.nio.file.{FileSystems, Path}

import scala.jdk.CollectionConverters.*

/** Problems of the core, for callers. */
private[api] object Problems:

  def ofCore(found: Vector[candela.diagnostics.Problem]): java.util.List[Problem] =
    java.util.List.copyOf(found.map(Problem(_)).asJava)

  /** The first error, or the first warning if there is none, and the number of further ones. */
  def summary(found: Vector[candela.diagnostics.Problem]): String =
    val (errors, warnings) = found.partition(_.severity == candela.diagnostics.Severity.Error)
    val (all, noun) = if errors.nonEmpty then (errors, "error") else (warnings, "warning")
    val first = Problem(all.head)
    all.size - 1 match
      case 0 => s"$first [${first.number}]"
      case 1 => s"$first [${first.number}], and 1 more $noun"
      case more => s"$first [${first.number}], and $more more ${noun}s"

  /** Runs `body` and turns its errors into a [[SceneException]]. */
  def thrown[A](body: => A): A =
    try body
    catch
      case e: SceneError => throw SceneException(e.problems)
      case e: ImageError => fail(e.code, e.getMessage)
      case e: MissingNatives => fail(Code.MissingLibrary, e.getMessage, Some(e.help))

  /** The path; of another file system, such as a zip's, its name would be another file's.
    *
    * @throws SceneError if it is of another one
    */
  def onDisk(path: Path): Path =
    if path.getFileSystem != FileSystems.getDefault then
      val help = Some("copy it to a file, or read its text: Candela.parse")
      val message = s"`$path` is no file of the default file system"
      throw SceneError(candela.diagnostics.Problem.general(Code.Unreadable, message, help))
    path

  def fail(code: Code, message: String, help: Option[String] = None): Nothing =
    throw SceneException(Vector(candela.diagnostics.Problem.general(code, message, help)))
