package candela.cli.terminal

import candela.base.{Figures, JavaHeap}
import candela.diagnostics.{
  Code, Excerpt, Problem, Refusal, SceneError, Severity, SourcePos, Visible
}
import candela.io.IoReason
import java.io.{IOException, UncheckedIOException}

import java.nio.channels.ClosedByInterruptException
import java.nio.file.{FileSystemException, InvalidPathException}

import candela.image.{ImageError, Natives}
import candela.render.RenderFailure
import candela.scenefile.Excerpts

/** Turns problems into text and exit codes; no other class does.
  *
  * @param canKeepGoing whether the command has the option `--keep-going`
  * @param canTellMore  whether the command has the option `--verbose`
  * @param hasColor     whether `err` shows colours
  */
final class Report(
    err: Printer,
    isQuiet: Boolean,
    isVerbose: Boolean,
    canKeepGoing: Boolean = true,
    hasColor: Boolean = false,
    canTellMore: Boolean = true
):

  private var errorCount = 0

  /** Number of errors so far. */
  def errors: Int = errorCount

  /** Runs a command on one input; reports its failure and returns its exit code. */
  def guarded(body: => ExitCode): ExitCode =
    try body
    catch
      case e: SceneError => errors(e.problems)
      case r: Refusal => errors(Excerpts.fill(Vector(r.problem)))
      case e: ImageError => errors(Vector(Problem.general(e.code, e.getMessage)))
      case e: UncheckedIOException =>
        errors(Vector(Problem.general(Code.Unreadable, ioMessage(e.getCause))))
      case e: IOException if !isInterrupt(e) =>
        errors(Vector(Problem.general(Code.Unreadable, ioMessage(e))))
      case e: InvalidPathException =>
        errors(Vector(Problem.general(
          Code.NoSuchFile,
          s"`${e.getInput}` is not a valid file name"
        )))
      case e: Throwable =>
        if causes(e).exists(_.isInstanceOf[OutOfMemoryError]) then outOfMemory()
        else if causes(e).exists(_.isInstanceOf[StackOverflowError]) then tooDeep()
        else if causes(e).exists(isOverflow) then tooMany()
        else if causes(e).exists(isInterrupt) then
          errors(Vector(Problem.general(
            Code.Interrupted,
            "the thread of this command was interrupted"
          )))
        else
          causes(e).flatMap(Natives.missing).headOption.fold(bug(e)): (what, help) =>
            errors(Vector(Problem.general(Code.MissingLibrary, what, Some(help))))

  /** Prints problems, at least one of them an error, in source order, and their count. */
  def errors(problems: Vector[Problem]): ExitCode =
    val (errors, warnings) = problems.partition(_.severity == Severity.Error)
    errorCount += errors.distinct.size
    this.warnings(warnings, all = isVerbose)
    val count = errors.distinct.size
    val kinds = grouped(errors, all = isVerbose)
    kinds.take(Report.MaxErrorKinds).foreach(printAll)
    val omitted = kinds.drop(Report.MaxErrorKinds).map((_, places) => places).sum
    if omitted > 0 then err.println(s"and ${Figures.count(omitted, "more error")}")
    else if count > 1 then err.println(Figures.count(count, "error"))
    if canKeepGoing && errors.forall(_.standIn.nonEmpty) then
      err.println(" --keep-going replaces what is missing with placeholders")
    ExitCode.BadInput

  /** Prints each warning once, in source order.
    *
    * @param all if false, prints equal messages only for their first position
    */
  def warnings(problems: Vector[Problem], all: Boolean): Unit =
    if !isQuiet then grouped(problems, all).foreach(printAll)

  /** Problems in source order, with the number of positions that share each message. */
  private def grouped(problems: Vector[Problem], all: Boolean): Vector[(Problem, Int)] =
    val ordered = Problem.byPlace(problems.distinct)
    if all then ordered.map((_, 1))
    else
      val counts = ordered.groupMapReduce(_.message)(_ => 1)(_ + _)
      ordered.distinctBy(_.message).map(p => (p, counts(p.message)))

  private def printAll(problem: Problem, places: Int): Unit =
    print(problem)
    if places > 1 then
      err.println(s" and at ${Figures.count(places - 1, "more position")}; --verbose shows all")

  private def print(problem: Problem): Unit = ProblemText.print(problem, err, hasColor)

  /** With the name of the file, if it is known. */
  private def ioMessage(e: IOException): String = e match
    case f: FileSystemException if f.getFile != null => s"can't read `${f.getFile}`: ${IoReason(f)}"
    case other => IoReason(other)

  /** An exception and its causes. */
  private def causes(e: Throwable): Vector[Throwable] =
    Vector.unfold(Option(e))(_.map(c => (c, Option(c.getCause)))).take(Report.MaxCauses)

  private def isInterrupt(e: Throwable): Boolean = e match
    case _: InterruptedException | _: ClosedByInterruptException => true
    case _ => false

  /** Sizes are computed such that they can't wrap around. */
  private def isOverflow(e: Throwable): Boolean = e match
    case a: ArithmeticException => String.valueOf(a.getMessage).endsWith("overflow")
    case _: NegativeArraySizeException => true
    case _ => false

  private def tooMany(): ExitCode =
    val message = "more values are needed at once than an array of Java can have, which are 2³¹"
    errors(Vector(Problem.general(
      Code.TooLarge,
      message,
      Some("fewer pixels, layers, photons or shapes may do")
    )))

  private def tooDeep(): ExitCode =
    val message = "the scene is nested too deeply: Java's stack is full"
    errors(Vector(Problem.general(Code.TooDeep, message, Some(JavaHeap.raised("-Xss64m")))))

  private def outOfMemory(): ExitCode =
    val limit = Figures.metric(JavaHeap.limit.toDouble)
    val message = s"out of memory: Java's heap is limited to ${limit}B"
    errors(Vector(Problem.general(Code.OutOfMemory, message, Some(JavaHeap.raise("8g")))))

  private def bug(e: Throwable): ExitCode =
    val (place, cause) = e match
      case f: RenderFailure => (s" at pixel (${f.x}, ${f.y}), sample ${f.sample}", f.getCause)
      case other => ("", other)
    val message = s"error: this is a bug in Candela: $cause$place"
    err.println(ProblemText.numbered(message, Code.Internal))
    if isVerbose || !canTellMore then cause.printStackTrace(err)
    if !isVerbose then
      val hint = if canTellMore then "; --verbose prints the stack trace" else ""
      err.println(s" please report it with its input$hint")
    ExitCode.Bug

object Report:
  /** Causes may refer to each other. */
  private val MaxCauses = 20

  /** Limit for readability. */
  private[cli] val MaxErrorKinds = 20

/** Formats a problem as text; no other class does:
  *
  * {{{
  * scenes/camera.pbrt:14:15: error: LookAt expects 9 numbers; number 4 is `Camera` [E0203]
  *  14 | LookAt 0 0 5  Camera
  *     |               ^
  *  usage: LookAt eye.x eye.y eye.z  look.x look.y look.z  up.x up.y up.z
  *  included from scenes/main.pbrt:3:1
  * }}}
  */
object ProblemText:

  private val Red = "31"
  private val Yellow = "33"

  /** The problem as lines, without a final line end. */
  def format(p: Problem): String =
    (s"${prefix(p)}${severity(p)}: ${numbered(p)}" +: below(p)).mkString("\n")

  /** Prints the problem.
    *
    * @param hasColor whether the terminal shows colours
    */
  def print(p: Problem, to: Printer, hasColor: Boolean): Unit =
    val color = if p.severity == Severity.Error then Red else Yellow
    if hasColor then to.println(prefix(p), severity(p), color, s": ${numbered(p)}")
    else to.println(s"${prefix(p)}${severity(p)}: ${numbered(p)}")
    below(p).foreach(to.println(_))

  private def numbered(p: Problem): String = numbered(p.message, p.code)

  /** A message with its number at the end, where it disturbs nobody. */
  def numbered(message: String, code: Code): String = s"$message [${code.word}]"

  private def prefix(p: Problem): String = p.pos.fold("")(at => s"$at: ")

  private def severity(p: Problem): String =
    if p.severity == Severity.Error then "error" else "warning"

  /** All lines after the first. */
  private def below(p: Problem): Vector[String] =
    val excerptLines = p.pos.zip(p.excerpt).toVector.flatMap(excerpt)
    excerptLines ++ p.help.map(h => s" $h") ++ p.pos.toVector.flatMap(includes)

  private def excerpt(at: SourcePos, text: String): Vector[String] =
    val number = at.line.toString
    val offset = Excerpt.caret(text, at.column) - 1
    // Keeps tabs, so the caret lines up at any tab width. What is shown of a control character may
    // be longer than one.
    val characters = text.codePoints.limit(offset).toArray
    val missing = " " * (offset - characters.length).max(0)
    val visible = Visible.line(String(characters, 0, characters.length)).codePoints.toArray
    val shift = visible.map(c => if c == '\t' then '\t' else ' ').mkString
    Vector(s" $number | $text", s" ${" " * number.length} | $shift$missing^")

  private def includes(at: SourcePos): Vector[String] =
    val lines =
      Vector.unfold(at.includedFrom)(_.map(from => (s" included from $from", from.includedFrom)))
    if lines.size <= MaxIncludes then lines
    else
      val halfLimit = MaxIncludes / 2
      (lines.take(halfLimit) :+ s" … ${lines.size - 2 * halfLimit} more …") ++ lines.takeRight(
        halfLimit
      )

  /** More, of files that include each other, are left out. */
  private val MaxIncludes = 10
