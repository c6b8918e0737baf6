package candela.cli.terminal

import candela.diagnostics.{Code, Problem, SceneError, SourcePos}
import java.io.IOException

import org.scalatest.funsuite.AnyFunSuite

import candela.cli.Captured
import candela.image.ImageError
import candela.render.RenderFailure

class ReportSuite extends AnyFunSuite:

  private def report(quiet: Boolean = false, verbose: Boolean = false)(use: Report => Any): String =
    val captured = Captured()
    val _ = use(Report(captured.terminal.err, quiet, verbose))
    captured.err

  private def at(line: Int, column: Int = 1) = SourcePos("a.pbrt", line, column)

  test("problems come by place, each once, and are counted"):
    val b = Problem.error(Code.Undefined, at(10), "b")
    val a = Problem.error(Code.Undefined, at(2, 5), "a")
    val text = report(): r =>
      assert(r.guarded(throw SceneError(Vector(b, a, b))) == ExitCode.BadInput)
    assert(text.linesIterator.toVector ==
      Vector("a.pbrt:2:5: error: a [E0403]", "a.pbrt:10:1: error: b [E0403]", "2 errors"))

  test("of many files within each other, the first and the last are named"):
    def nested(depth: Int): SourcePos =
      val outer = Option.when(depth > 0)(nested(depth - 1))
      SourcePos(s"$depth.pbrt", 1, 1, outer)
    def lines(depth: Int) =
      report()(_.errors(Vector(Problem.error(Code.Undefined, nested(depth), "a")))).linesIterator
    assert(lines(10).size == 11 && !lines(10).exists(_.contains("more")))
    val long = lines(200).toVector
    assert(long.size == 12 && long(6) == " … 190 more …")
    assert(long(5) == " included from 195.pbrt:1:1" && long.last == " included from 0.pbrt:1:1")

  test("full stacks, interrupted threads and impossible names are errors, not bugs"):
    def caught(e: Throwable): String = report(): r =>
      assert(r.guarded(throw e) == ExitCode.BadInput)
    assert(caught(StackOverflowError()).contains("nested too deeply"))
    val within = RenderFailure(0, 0, 0, StackOverflowError())
    assert(caught(within).contains("nested too deeply"))
    for e <- Vector(NegativeArraySizeException("-4"), ArithmeticException("integer overflow")) do
      assert(caught(e).contains("more values are needed at once"))
    val division =
      report()(r => assert(r.guarded(throw ArithmeticException("/ by zero")) == ExitCode.Bug))
    assert(division.contains("bug"))
    for e <- Vector(InterruptedException(), java.nio.channels.ClosedByInterruptException()) do
      assert(caught(e).contains("was interrupted"))
    val zero = java.nio.file.InvalidPathException("a\u0000", "zero")
    assert(caught(zero).contains("is not a valid file name"))

  test("colours mark errors and warnings where the terminal has them"):
    val captured = Captured()
    val report = Report(captured.terminal.err, false, false, hasColor = true)
    val _ = report.errors(Vector(
      Problem.error(Code.Undefined, at(1), "a"),
      Problem.warning(Code.Undefined, at(2), "b")
    ))
    assert(captured.err == "a.pbrt:2:1: \u001b[1;33mwarning\u001b[0m: b [E0403]\n" +
      "a.pbrt:1:1: \u001b[1;31merror\u001b[0m: a [E0403]\n")

  test("colours are for terminals, and not with NO_COLOR"):
    def terminal(isInteractive: Boolean, environment: (String, String)*) =
      Terminal(System.out, System.err, isInteractive, Interrupts.Ignored, 80, environment.toMap)
    assert(terminal(isInteractive = true).hasColor)
    assert(terminal(isInteractive = true, "NO_COLOR" -> "").hasColor)
    assert(!terminal(isInteractive = true, "NO_COLOR" -> "1").hasColor)
    assert(!terminal(isInteractive = false).hasColor)

  test("one error is not counted"):
    val problem = Problem.general(Code.Undefined, "a", Some("b"))
    assert(report()(_.errors(Vector(problem))) == "error: a [E0403]\n b\n")

  test("bad images and failing disks are bad input"):
    val _ = report(): r =>
      assert(r.guarded(throw ImageError(Code.Undefined, "a")) == ExitCode.BadInput)
      assert(r.guarded(throw IOException("a")) == ExitCode.BadInput)

  private val warnings = Vector(
    Problem.warning(Code.Undefined, at(9), "no `Kdd`"),
    Problem.warning(Code.Undefined, at(3), "no `Kdd`"),
    Problem.warning(Code.Undefined, at(5), "no `foo`"),
    Problem.warning(Code.Undefined, at(3), "no `Kdd`")
  )

  test("the same warning at many places is printed for the first of them"):
    assert(report()(_.warnings(warnings, all = false)).linesIterator.toVector == Vector(
      "a.pbrt:3:1: warning: no `Kdd` [E0403]",
      " and at 1 more position; --verbose shows all",
      "a.pbrt:5:1: warning: no `foo` [E0403]"
    ))

  test("all warnings are printed for who wants them"):
    assert(report()(_.warnings(warnings, all = true)).linesIterator.toVector == Vector(
      "a.pbrt:3:1: warning: no `Kdd` [E0403]",
      "a.pbrt:5:1: warning: no `foo` [E0403]",
      "a.pbrt:9:1: warning: no `Kdd` [E0403]"
    ))

  test("quiet means no warnings, but errors"):
    val problems = warnings :+ Problem.error(Code.Undefined, at(20), "bad")
    assert(report(quiet = true)(_.warnings(warnings, all = true)) == "")
    assert(report(quiet = true)(_.errors(problems)) == "a.pbrt:20:1: error: bad [E0403]\n")

  test("a failed sample is a bug, with its place; the stack trace only if asked for"):
    val failure = RenderFailure(3, 7, 5, ArithmeticException("/ by zero"))
    val first = "error: this is a bug in Candela: java.lang.ArithmeticException: / by zero" +
      " at pixel (3, 7), sample 5 [E0116]"
    val short = report()(r => assert(r.guarded(throw failure) == ExitCode.Bug))
    assert(short.linesIterator.next() == first)
    assert(!short.contains("\tat "))
    val long = report(verbose = true)(r => assert(r.guarded(throw failure) == ExitCode.Bug))
    assert(long.linesIterator.next() == first)
    assert(long.contains("\tat candela.cli.terminal.ReportSuite"))

  test("any other exception is a bug too"):
    val _ = report()(r => assert(r.guarded(throw AssertionError()) == ExitCode.Bug))

  test("too little memory is no bug, in a worker neither"):
    for e <- Vector(OutOfMemoryError(), RenderFailure(0, 0, 0, OutOfMemoryError())) do
      val text = report()(r => assert(r.guarded(throw e) == ExitCode.BadInput))
      assert(text.contains("-Xmx"))

class ProblemTextSuite extends AnyFunSuite:

  test("place, line, caret, help and includes each have their line"):
    val main = SourcePos("main.pbrt", 3, 1)
    val at = SourcePos("camera.pbrt", 14, 15, Some(SourcePos("part.pbrt", 2, 5, Some(main))))
    val error = Problem.error(Code.Undefined, at, "wrong", Some("so"))
    val problem = error.copy(excerpt = Some("LookAt 0 0 5  Camera"))
    assert(
      ProblemText.format(problem) ==
        """camera.pbrt:14:15: error: wrong [E0403]
          | 14 | LookAt 0 0 5  Camera
          |    |               ^
          | so
          | included from part.pbrt:2:5
          | included from main.pbrt:3:1""".stripMargin
    )

  test("a problem without place has neither place nor line"):
    val problem = Problem.general(Code.Undefined, "wrong", Some("so"))
    assert(ProblemText.format(problem) == "error: wrong [E0403]\n so")

  test("warnings are called so"):
    val warning = Problem.warning(Code.Undefined, SourcePos("a", 1, 2), "odd")
    assert(ProblemText.format(warning) == "a:1:2: warning: odd [E0403]")

  test("tabs before the caret stay tabs, and a wide character is one column"):
    val error = Problem.error(Code.Undefined, SourcePos("a", 1, 4), "wrong")
    val problem = error.copy(excerpt = Some("\t😀 x"))
    assert(ProblemText.format(problem).linesIterator.toVector.last == "   | \t  ^")

  test("a caret behind the end of the line is shown there"):
    val problem =
      Problem.error(Code.Undefined, SourcePos("a", 1, 4), "wrong").copy(excerpt = Some("x"))
    assert(ProblemText.format(problem).linesIterator.toVector.last == "   |    ^")
