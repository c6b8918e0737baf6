package candela.cli

import candela.base.{Problem, SceneError, SourcePos}
import candela.image.ImageError
import candela.render.RenderFailure

import java.io.IOException

import org.scalatest.funsuite.AnyFunSuite

class ReportSuite extends AnyFunSuite:

  private def report(quiet: Boolean = false, verbose: Boolean = false)(use: Report => Any): String =
    val captured = Captured()
    val _ = use(Report(captured.terminal.err, quiet, verbose))
    captured.err

  private def at(line: Int, column: Int = 1) = SourcePos("a.pbrt", line, column)

  test("problems come by place, each once, and are counted"):
    val b = Problem.error(at(10), "b")
    val a = Problem.error(at(2, 5), "a")
    val text = report(): r =>
      assert(r.guarded(throw SceneError(Vector(b, a, b))) == ExitCode.BadInput)
    assert(text.linesIterator.toVector ==
      Vector("a.pbrt:2:5: error: a", "a.pbrt:10:1: error: b", "2 errors"))

  test("one error is not counted"):
    assert(report()(_.errors(Vector(Problem.general("a", Some("b"))))) == "error: a\n b\n")

  test("bad images and failing disks are bad input"):
    val _ = report(): r =>
      assert(r.guarded(throw ImageError("a")) == ExitCode.BadInput)
      assert(r.guarded(throw IOException("a")) == ExitCode.BadInput)

  private val warnings = Vector(
    Problem.warning(at(9), "no `Kdd`"),
    Problem.warning(at(3), "no `Kdd`"),
    Problem.warning(at(5), "no `foo`"),
    Problem.warning(at(3), "no `Kdd`")
  )

  test("the same warning at many places is printed for the first of them"):
    assert(report()(_.warnings(warnings, all = false)).linesIterator.toVector == Vector(
      "a.pbrt:3:1: warning: no `Kdd`",
      " and at 1 more place; --verbose shows all",
      "a.pbrt:5:1: warning: no `foo`"
    ))

  test("all warnings are printed for who wants them"):
    assert(report()(_.warnings(warnings, all = true)).linesIterator.toVector == Vector(
      "a.pbrt:3:1: warning: no `Kdd`",
      "a.pbrt:5:1: warning: no `foo`",
      "a.pbrt:9:1: warning: no `Kdd`"
    ))

  test("quiet means no warnings, but errors"):
    val problems = warnings :+ Problem.error(at(20), "bad")
    assert(report(quiet = true)(_.warnings(warnings, all = true)) == "")
    assert(report(quiet = true)(_.errors(problems)) == "a.pbrt:20:1: error: bad\n")

  test("a failed sample is a bug, with its place; the stack trace only if asked for"):
    val failure = RenderFailure(3, 7, 5, ArithmeticException("/ by zero"))
    val first = "error: this is a bug in Candela: java.lang.ArithmeticException: / by zero" +
      " at pixel (3, 7), sample 5"
    val short = report()(r => assert(r.guarded(throw failure) == ExitCode.Bug))
    assert(short.linesIterator.next() == first)
    assert(!short.contains("\tat "))
    val long = report(verbose = true)(r => assert(r.guarded(throw failure) == ExitCode.Bug))
    assert(long.linesIterator.next() == first)
    assert(long.contains("\tat candela.cli.ReportSuite"))

  test("any other exception is a bug too"):
    val _ = report()(r => assert(r.guarded(throw StackOverflowError()) == ExitCode.Bug))

  test("too little memory is no bug, in a worker neither"):
    for e <- Vector(OutOfMemoryError(), RenderFailure(0, 0, 0, OutOfMemoryError())) do
      val text = report()(r => assert(r.guarded(throw e) == ExitCode.BadInput))
      assert(text.contains("-Xmx"))
