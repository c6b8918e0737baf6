package candela.suite

import java.io.File
import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit

import scala.jdk.CollectionConverters.*

/** How one run ended: after how many seconds; or why there is no image. */
enum Outcome:
  case Done(seconds: Double)
  case Failed(why: String)

  /** Ended because nobody waits for it any more. */
  case Cancelled

/** Starts programs.
  *
  * @param self        the words that start Candela itself
  * @param scratch     where they run, and write their logs
  * @param isCancelled asked again and again while they run
  */
final class Commands(self: Vector[String], scratch: Path, isCancelled: () => Boolean = () => false):

  /** Why a program can't be started, if it can't. */
  def missing(program: Program): Option[String] =
    val unset = program.needs.filterNot(sys.env.contains)
    program.command.headOption match
      case _ if unset.nonEmpty => Some(Commands.notSet(unset))
      case None => Some("no command is given")
      case Some("{candela}") => None
      case Some(word) => Option.when(executable(word).isEmpty)(s"`$word` is not installed")

  /** The words of a command, filled in. */
  def words(program: Program, values: Map[String, String]): Vector[String] =
    program.command.flatMap:
      case "{candela}" => self
      case word => Vector(Commands.filled(word, values))

  /** Runs one to its end, and measures the wall clock. `out` must be there afterwards. */
  def run(words: Vector[String], out: Path, timeout: Double): Outcome =
    val _ = Files.deleteIfExists(out)
    val log = scratch.resolve("log.txt").toFile
    val builder = ProcessBuilder(words.asJava).directory(scratch.toFile)
      .redirectErrorStream(true).redirectOutput(log)
      .redirectInput(ProcessBuilder.Redirect.from(File(Commands.NullDevice)))
    val started = System.nanoTime
    val process = builder.start()
    try
      def elapsed = (System.nanoTime - started) * 1e-9
      // It returns as soon as the program ends, whatever the time that it would wait.
      def ended(): Boolean = process.waitFor(Commands.Patience, TimeUnit.MILLISECONDS)
      var hasEnded = ended()
      while !hasEnded && elapsed < timeout && !isCancelled() do hasEnded = ended()
      val seconds = elapsed
      // A Ctrl-C that ends it may be known here a moment later
      if hasEnded && process.exitValue != 0 then TimeUnit.MILLISECONDS.sleep(Commands.Patience)
      if isCancelled() then Outcome.Cancelled
      else if !hasEnded then Outcome.Failed(s"took longer than $timeout s")
      else if process.exitValue != 0 then
        Outcome.Failed(s"ended with ${process.exitValue}: ${lastWords(log.toPath)}")
      else if !Files.isRegularFile(out) then
        Outcome.Failed(s"wrote no image: ${lastWords(log.toPath)}")
      else Outcome.Done(seconds)
    finally
      // Also when the waiting is interrupted: nothing runs on behind the user's back.
      val _ = process.destroyForcibly().waitFor()

  private def lastWords(log: Path): String =
    val lines = String(Files.readAllBytes(log), "UTF-8").linesIterator.filter(_.trim.nonEmpty)
    lines.toVector.lastOption.fold("it said nothing")(_.trim.take(200))

  private def executable(word: String): Option[Path] =
    if word.contains('/') then Option(Path.of(word)).filter(Files.isExecutable(_))
    else
      sys.env.getOrElse("PATH", "").split(File.pathSeparatorChar).toVector
        .map(folder => Path.of(folder).resolve(word))
        .find(Files.isExecutable(_))

object Commands:
  /** Milliseconds from a cancellation until it is noticed. */
  private val Patience = 100L

  private val NullDevice = if File.separatorChar == '\\' then "NUL" else "/dev/null"

  def notSet(variables: Vector[String]): String =
    s"the variable ${variables.mkString(", ")} is not set"

  def filled(text: String, values: Map[String, String]): String =
    values.foldLeft(text):
      case (t, (name, value)) => t.replace(s"{$name}", value)
