package candela.api

import candela.base.JavaHeap
import candela.diagnostics.{Code, SceneError}
import candela.image.{ImageError, MissingNatives, Natives}
import candela.render.Costs

import java.nio.file.{FileSystems, Path}
import java.util.concurrent.CancellationException

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
      case 0 => first.toString
      case 1 => s"$first, and 1 more $noun"
      case more => s"$first, and $more more ${noun}s"

  /** Made before: a full heap has no room for it. */
  private val FullHeap =
    SceneException(Vector(Costs(Vector.empty).problem(JavaHeap.limit, None)))

  /** Runs `body` and turns its errors into a [[SceneException]]. */
  def thrown[A](body: => A): A =
    try uninterrupted(body)
    catch
      case e: SceneError => throw SceneException(e.problems)
      case e: ImageError => fail(e.code, e.getMessage)
      case e: MissingNatives => fail(Code.MissingLibrary, e.getMessage, Some(e.help))
      case e: LinkageError =>
        Natives.missing(e).fold(throw e)((what, help) =>
          fail(Code.MissingLibrary, what, Some(help))
        )
      case _: OutOfMemoryError => throw FullHeap

  /** Runs `body`, unless its thread is interrupted, which remains so.
    *
    * @throws CancellationException if it is, also where `body` takes that for an unreadable file
    */
  def uninterrupted[A](body: => A): A =
    def isInterrupted = Thread.currentThread.isInterrupted
    def cancelled = CancellationException("the calling thread was interrupted")
    try
      if isInterrupted then throw cancelled
      body
    catch
      case _: InterruptedException =>
        Thread.currentThread.interrupt()
        throw cancelled
      case _: SceneError | _: ImageError if isInterrupted => throw cancelled

  /** What an interrupted thread has read may lack files that it could not.
    *
    * @throws InterruptedException if the thread is interrupted
    */
  def checkInterrupt(): Unit =
    if Thread.currentThread.isInterrupted then throw InterruptedException()

  /** The path; of another file system, such as a zip's, its name would be another file's.
    *
    * @param code if it is of another one
    * @param help likewise, what to do instead
    * @throws SceneError if it is of another one
    */
  def onDisk(
      path: Path,
      code: Code = Code.Unreadable,
      help: String = "copy it to a file, or read its text: Candela.parse"
  ): Path =
    if path.getFileSystem != FileSystems.getDefault then
      val message = s"`$path` is no file of the default file system"
      throw SceneError(candela.diagnostics.Problem.general(code, message, Some(help)))
    path

  def fail(code: Code, message: String, help: Option[String] = None): Nothing =
    throw SceneException(Vector(candela.diagnostics.Problem.general(code, message, help)))
