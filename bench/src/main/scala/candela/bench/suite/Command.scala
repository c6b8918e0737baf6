package candela.bench.suite

import java.io.File
import java.nio.file.{Files, Path}
import java.util.concurrent.TimeUnit

import scala.jdk.CollectionConverters.*

/** Result of a run: its time in seconds and its peak memory in bytes, if known; or why it wrote no
  * image.
  */
enum Outcome:
  case Done(seconds: Double, memory: Option[Long])
  case Failed(why: String)

  /** Ended by cancellation. */
  case Cancelled

/** Starts programs.
  *
  * @param self command that starts Candela itself
  * @param scratch working folder of the programs, for images and logs
  * @param isCancelled polled while they run
  */
open class Commands(self: Vector[String], scratch: Path, isCancelled: () => Boolean = () => false):

  /** Why a program can't be started; None if it can. */
  def missing(program: Program): Option[String] =
    val unset = program.needs.filterNot(sys.env.contains)
    program.command.headOption match
      case _ if unset.nonEmpty => Some(Commands.notSet(unset))
      case None => Some("no command")
      case Some(Commands.Self) => None
      case Some(word) => Option.unless(Commands.isExecutable(word))(s"`$word` is not installed")

  /** A command's words with its placeholders substituted. */
  def words(program: Program, values: Map[String, String]): Vector[String] =
    program.command.flatMap:
      case Commands.Self => self
      case word => Vector(Commands.filled(word, values))

  /** Runs a command to its end and measures its wall-clock time and peak memory. It must write
    * `out`.
    */
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
      // Returns as soon as the program ends.
      def ended(): Boolean = process.waitFor(Commands.PollMillis, TimeUnit.MILLISECONDS)
      var memory = PeakMemory.of(process.toHandle)
      var hasEnded = ended()
      while !hasEnded && elapsed < timeout && !isCancelled() do
        memory = PeakMemory.of(process.toHandle).orElse(memory)
        hasEnded = ended()
      val seconds = elapsed
      // A Ctrl-C that ends the program may be noticed a moment later.
      if hasEnded && process.exitValue != 0 then TimeUnit.MILLISECONDS.sleep(Commands.Afterthought)
      if isCancelled() then Outcome.Cancelled
      else if !hasEnded then Outcome.Failed(s"took longer than $timeout s")
      else if process.exitValue != 0 then
        Outcome.Failed(s"exit code ${process.exitValue}: ${lastWords(log.toPath)}")
      else if !Files.isRegularFile(out) then
        Outcome.Failed(s"wrote no image: ${lastWords(log.toPath)}")
      else Outcome.Done(seconds, memory)
    finally
      // Also if the wait is interrupted: no process outlives the run.
      val _ = process.destroyForcibly().waitFor()

  /** The first line that names an error, else the last one. */
  private def lastWords(log: Path): String =
    val text = Commands.Colours.replaceAllIn(String(Files.readAllBytes(log), "UTF-8"), "")
    val lines = text.linesIterator.filter(_.trim.nonEmpty).toVector
    val named = lines.find(line => !line.head.isWhitespace && Commands.NamesError.matches(line))
    named.orElse(lines.lastOption).fold("no output")(_.trim.take(200))

object Commands:
  /** The program itself, which may be several words. */
  val Self = "{candela}"

  /** Placeholders of edits. */
  val EditPlaceholders: Vector[String] = Vector("{spp}", "{seed}", "{threads}")

  /** Placeholders of commands. */
  val Placeholders: Vector[String] = Vector(Self, "{scene}", "{out}") ++ EditPlaceholders

  /** As in `error[E0001]: …`, `ValueError: …`, `… FATAL …`. */
  private val NamesError =
    """.*([Ee]rror|[Ee]xception)(\[\w+\])?:.*|.*\b(ERROR|FATAL|[Ff]atal)\b.*""".r

  /** A terminal's control sequences. */
  private val Colours = "\u001b\\[[0-9;]*m".r

  /** Polling interval for cancellation and memory, in milliseconds. */
  private val PollMillis = 20L

  /** After a failure, in milliseconds. */
  private val Afterthought = 100L

  private val NullDevice = if File.separatorChar == '\\' then "NUL" else "/dev/null"

  /** Whether a command can be started: a file, or a name on the path. */
  def isExecutable(word: String): Boolean =
    if word.contains('/') then Files.isExecutable(Path.of(word))
    else
      sys.env.getOrElse("PATH", "").split(File.pathSeparatorChar)
        .exists(folder => Files.isExecutable(Path.of(folder).resolve(word)))

  def notSet(variables: Vector[String]): String =
    s"environment variable ${variables.mkString(", ")} is not set"

  def filled(text: String, values: Map[String, String]): String =
    values.foldLeft(text):
      case (t, (name, value)) => t.replace(s"{$name}", value)
