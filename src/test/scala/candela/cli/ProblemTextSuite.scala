package candela.cli

import candela.base.{Problem, SourcePos}
import org.scalatest.funsuite.AnyFunSuite

class ProblemTextSuite extends AnyFunSuite:

  test("place, line, caret, help and includes each have their line"):
    val main = SourcePos("main.pbrt", 3, 1)
    val at = SourcePos("camera.pbrt", 14, 15, Some(SourcePos("part.pbrt", 2, 5, Some(main))))
    val error = Problem.error(at, "wrong", Some("so"))
    val problem = error.copy(excerpt = Some("LookAt 0 0 5  Camera"))
    assert(
      ProblemText.format(problem) ==
        """camera.pbrt:14:15: error: wrong
          | 14 | LookAt 0 0 5  Camera
          |    |               ^
          | so
          | included from part.pbrt:2:5
          | included from main.pbrt:3:1""".stripMargin
    )

  test("a problem without place has neither place nor line"):
    assert(ProblemText.format(Problem.general("wrong", Some("so"))) == "error: wrong\n so")

  test("warnings are called so"):
    val warning = Problem.warning(SourcePos("a", 1, 2), "odd")
    assert(ProblemText.format(warning) == "a:1:2: warning: odd")

  test("tabs before the caret stay tabs, and a wide character is one column"):
    val problem = Problem.error(SourcePos("a", 1, 4), "wrong").copy(excerpt = Some("\t😀 x"))
    assert(ProblemText.format(problem).linesIterator.toVector.last == "   | \t  ^")

  test("a caret behind the end of the line is shown there"):
    val problem = Problem.error(SourcePos("a", 1, 4), "wrong").copy(excerpt = Some("x"))
    assert(ProblemText.format(problem).linesIterator.toVector.last == "   |    ^")
