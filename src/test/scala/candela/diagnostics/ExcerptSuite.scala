package candela.diagnostics

import org.scalacheck.Gen
import org.scalatest.funsuite.AnyFunSuite
import org.scalatestplus.scalacheck.ScalaCheckPropertyChecks

class ExcerptSuite extends AnyFunSuite with ScalaCheckPropertyChecks:

  private def excerpt(line: String, column: Int): String =
    Excerpt.of(line.take(column - 1), line.drop(column - 1), column)

  test("a line of up to 200 characters is whole"):
    val line = "x" * 200
    assert(excerpt(line, 1) == line && excerpt(line, 200) == line)
    assert(Excerpt.caret(line, 200) == 200)

  test("of any line at most 200 characters are shown, and the caret meets the same character"):
    val cases =
      for length <- Gen.choose(1, 1000); column <- Gen.choose(1, length) yield (length, column)
    forAll(cases): (length, column) =>
      val line = String(Array.tabulate(length)(i => ('a' + i % 26).toChar))
      val shown = excerpt(line, column)
      assert(shown.length <= 200)
      assert(shown(Excerpt.caret(shown, column) - 1) == line(column - 1))

  test("the ends of the line are enough to make an excerpt"):
    val line = "ab" * 5000
    val near = Excerpt.of(line.slice(4000, 5000), line.slice(5000, 6000), 5001)
    assert(near == excerpt(line, 5001))
