package candela.cli

import candela.base.{Problem, SceneError, Severity}
import candela.image.ImageError
import candela.render.RenderFailure

import java.io.{IOException, PrintStream, UncheckedIOException}

/** The one place where problems become text and exit codes. */
final class Report(err: PrintStream, isQuiet: Boolean, isVerbose: Boolean):

  /** Runs a command on one input; what goes wrong is said, and ends only this input. */
  def guarded(body: => ExitCode): ExitCode =
    try body
    catch
      case e: SceneError => errors(e.problems)
      case e: ImageError => errors(Vector(Problem.general(e.getMessage)))
      case e: UncheckedIOException => errors(Vector(Problem.general(ioMessage(e.getCause))))
      case e: IOException => errors(Vector(Problem.general(ioMessage(e))))
      case e: Throwable => if isMemory(e) then outOfMemory() else bug(e)

  /** Prints problems, of which at least one is an error, by place, and how many there are. */
  def errors(problems: Vector[Problem]): ExitCode =
    sorted(problems).filter(p => p.severity == Severity.Error || !isQuiet).foreach(print)
    val count = problems.distinct.count(_.severity == Severity.Error)
    if count > 1 then err.println(Figures.count(count, "error"))
    ExitCode.BadInput

  /** Prints each warning once, by place.
    *
    * @param all else the same message at many places is printed for the first one
    */
  def warnings(problems: Vector[Problem], all: Boolean): Unit =
    if !isQuiet then
      val ordered = sorted(problems)
      if all then ordered.foreach(print)
      else
        val places = ordered.groupBy(_.message)
        for first <- ordered.distinctBy(_.message) do
          print(first)
          val more = places(first.message).size - 1
          if more > 0 then
            err.println(s" and at ${Figures.count(more, "more place")}; --verbose shows all")

  private def print(problem: Problem): Unit = err.println(ProblemText.format(problem))

  private def sorted(problems: Vector[Problem]): Vector[Problem] =
    problems.distinct.sortBy(p => p.at.fold(("", 0, 0))(at => (at.file, at.line, at.column)))

  private def ioMessage(e: IOException): String = s"${e.getClass.getSimpleName}: ${e.getMessage}"

  private def isMemory(e: Throwable): Boolean =
    e.isInstanceOf[OutOfMemoryError] || Option(e.getCause).exists(isMemory)

  private def outOfMemory(): ExitCode =
    val limit = Figures.metric(Runtime.getRuntime.maxMemory.toDouble)
    val message = s"the ${limit}B of memory that Java may take are not enough"
    val help = "let Java take more, e.g. with the environment variable JAVA_TOOL_OPTIONS=-Xmx8g"
    errors(Vector(Problem.general(message, Some(help))))

  private def bug(e: Throwable): ExitCode =
    val (place, cause) = e match
      case f: RenderFailure => (s" at pixel (${f.x}, ${f.y}), sample ${f.sample}", f.getCause)
      case other => ("", other)
    err.println(s"error: this is a bug in Candela: $cause$place")
    if isVerbose then cause.printStackTrace(err)
    else err.println(" please report it with the scene; --verbose shows where in the program it is")
    ExitCode.Bug
