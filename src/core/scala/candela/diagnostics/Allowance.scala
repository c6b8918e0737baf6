package candela.diagnostics

import java.nio.file.Path
import java.util.concurrent.ConcurrentHashMap
import java.util.concurrent.atomic.AtomicLong

import scala.util.control.ControlThrowable

/** Ends the work on a scene that asks for what it may not have, whatever is caught on the way.
  * [[Refusal.asError]] makes an error of it.
  */
final class Refusal(val problem: Problem) extends ControlThrowable:

  private def placed(at: SourcePos): Refusal =
    if problem.pos.nonEmpty then this else new Refusal(problem.copy(pos = Some(at)))

object Refusal:
  def apply(code: Code, at: Option[SourcePos], message: String, help: String): Refusal =
    new Refusal(Problem.error(code, at, message, Some(help)))

  /** That of a file outside of a sandbox: unlike a limit, it leaves the rest to be looked at. */
  object OfFile:
    def unapply(r: Refusal): Option[Problem] =
      Option.when(r.problem.code == Code.Sandboxed)(r.problem)

  /** Runs `body`; a refusal in it that has no place is here. */
  def placed[A](at: => SourcePos)(body: => A): A =
    try body
    catch case r: Refusal => throw r.placed(at)

  /** Runs `body`; a refusal in it is an error.
    *
    * @param shown adds the excerpt
    */
  def asError[A](shown: Vector[Problem] => Vector[Problem])(body: => A): A =
    try body
    catch case r: Refusal => throw SceneError(shown(Vector(r.problem)))

/** What is limited, and by how much in a sandbox. Time is in milliseconds. */
enum Limit(val word: String, val inSandbox: Long):
  case Files extends Limit("files", 10_000)
  case Bytes extends Limit("bytes", 4_000_000_000L)
  case Triangles extends Limit("triangles", 50_000_000)
  case Pixels extends Limit("pixels", 100_000_000)
  case Depth extends Limit("depth", 1000)
  case Samples extends Limit("samples", 65_536)
  case Time extends Limit("time", 3_600_000)

/** How much a scene may use, and what it has used so far. Safe for threads.
  *
  * @param limits  what is missing has no limit
  * @param endsAt  when the time is over, in nanoseconds of the system's clock
  */
final class Allowance(limits: Map[Limit, Long] = Map.empty, endsAt: Option[Long] = None):
  private val files = ConcurrentHashMap.newKeySet[Path]()
  private val bytes, shapes = AtomicLong()

  /** The limit, if there is one and it is below `other`. */
  def capped(limit: Limit, other: Int): Int = limits.get(limit).fold(other)(_.min(other).toInt)

  /** @param what the amount is of, for the message
    * @throws Refusal if that is more than allowed
    */
  def check(limit: Limit, amount: Long, at: Option[SourcePos])(what: => String): Unit =
    checkTime(at)
    for most <- limits.get(limit) if amount > most do
      throw Refusal(
        Code.LimitExceeded,
        at,
        s"$what; at most $most are allowed",
        s"--limit ${limit.word}=N changes the limit"
      )

  /** Counts a file once, however often it is opened. */
  def countFile(file: Path, at: Option[SourcePos]): Unit =
    if limits.contains(Limit.Files) && files.add(file) then
      check(Limit.Files, files.size, at)(s"`${file.getFileName}` is file number ${files.size}")

  /** Counts bytes as often as they are read, and those that they unpack to. */
  def countBytes(count: Long, file: Path, at: Option[SourcePos]): Unit =
    checkTime(at)
    if limits.contains(Limit.Bytes) then
      val total = bytes.addAndGet(count)
      check(Limit.Bytes, total, at)(s"with `${file.getFileName}`, $total bytes are read")

  /** Counts triangles, other shapes, instances and lights: what fills the memory. */
  def countShapes(count: Long, at: Option[SourcePos]): Unit =
    val total = shapes.addAndGet(count)
    check(Limit.Triangles, total, at)(s"there are $total triangles and other shapes")

  /** Forgets what has been read: it is read once more. */
  def readAgain(): Unit =
    files.clear()
    bytes.set(0)

  /** Nanoseconds until the time is over, if it ever is. */
  def timeLeft: Option[Long] = endsAt.map(_ - System.nanoTime)

  /** @param at the statement that is read or built
    * @throws Refusal if the time is over
    */
  def checkTime(at: => Option[SourcePos]): Unit =
    if timeLeft.exists(_ <= 0) then
      throw new Refusal(Allowance.outOfTime(limits.getOrElse(Limit.Time, 0)).copy(pos = at))

object Allowance:
  /** @param limit in milliseconds */
  def outOfTime(limit: Long): Problem =
    val seconds = BigDecimal(limit) / 1000
    Problem.general(
      Code.LimitExceeded,
      s"the time limit of ${seconds.bigDecimal.stripTrailingZeros.toPlainString} s is reached; " +
        "no image is written",
      Some("--limit time=T changes the limit; --time T ends a rendering with its image")
    )
