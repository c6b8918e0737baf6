package candela.scenefile

import candela.diagnostics.{Code, Problem, SceneError, SourcePos}

import org.scalatest.funsuite.AnyFunSuite

class LineReaderSuite extends AnyFunSuite:
  private val fail: (Int, Int, String) => Nothing = (line, column, message) =>
    throw SceneError(Problem.error(Code.Arguments, SourcePos("a", line, column), message))

  private def reader(text: String, room: Int = 1 << 16, continues: Boolean = true) =
    LineReader(Source.windowed("a", text.getBytes("UTF-8"), room), continues, true, fail)

  private def words(text: String, room: Int): Vector[(Int, Vector[String])] =
    val in = reader(text, room)
    Iterator.continually(in.advance()).takeWhile(identity).map: _ =>
      in.line -> Iterator.continually(in.hasNext).takeWhile(identity).map(_ => in.word()).toVector
    .toVector

  test("lines end in three ways, continue after a backslash, and have comments"):
    val text = "a b\r\n c\\\r\nd # e\n\n\rf\\\n\\\n g"
    val expected = Vector(
      1 -> Vector("a", "b"),
      2 -> Vector("c", "d"),
      4 -> Vector.empty,
      5 -> Vector.empty,
      6 -> Vector("f", "g")
    )
    for room <- 1 to 40 do assert(words(text, room) == expected, room)

  test("numbers are read in their places, and are complained about there"):
    val in = reader(" v 1.5 -2e3 1e99 x12")
    assert(in.advance() && in.word() == "v" && in.float() == 1.5f && in.finite() == -2000f)
    def problem(body: => Any) =
      val p = intercept[SceneError](body).problems.head
      (p.pos.get.line, p.pos.get.column, p.message)
    assert(problem(in.finite()) == (1, 13, "expected a finite number, found `1e99`"))
    in.passNumber()
    assert(problem(in.float()) == (1, 18, "expected a number, found `x12`"))
    assert(in.word() == "x12")
    assert(problem(in.float())._3 == "expected a number, found the end of the line")

  test("the rest of a line may have spaces and quotes"):
    val in = reader("a  b c \nd \"e f\"\ng\n")
    val rests = Vector.fill(3):
      val _ = in.advance() && in.word().nonEmpty
      in.remainder()
    assert(rests == Vector(
      PlacedText("b c", 1, 4),
      PlacedText("e f", 2, 3),
      PlacedText("", 3, 2)
    ))

  test("words that are no numbers are known"):
    for text <- Vector("nan", "-nan(ind)", "inf", "+Infinity", "1.#QNAN", "-1.#IND") do
      val in = reader(text)
      assert(in.advance() && in.isUndefined, text)
    val in = reader("1.5")
    assert(in.advance() && !in.isUndefined)
