package candela.cli.terminal

import org.scalatest.funsuite.AnyFunSuite

class TextTableSuite extends AnyFunSuite:

  test("columns are as wide as their widest cell"):
    val rows = Vector(Vector("a", "bb", "first"), Vector("aaa", "b", "second"))
    assert(TextTable(80).lines(rows) == Vector("  a    bb  first", "  aaa  b   second"))

  test("the last column wraps between words, under itself"):
    val rows = Vector(Vector("name", "some words that do not fit on one line"))
    val lines = TextTable(32).lines(rows)
    assert(lines == Vector("  name  some words that do not", "        fit on one line"))
    assert(lines.forall(_.length <= 32))

  test("wide cells of other columns wrap, too"):
    val cell = "a default that is told in many words"
    val lines = TextTable(80).lines(Vector(Vector(cell, "meaning")))
    assert(lines.size == 2 && lines.head.contains("meaning"))

  test("a word that is too long stays whole"):
    assert(TextTable.wrap("a interminableword b", 5) == Vector("a", "interminableword", "b"))

  test("nothing is no line"):
    assert(TextTable(80).lines(Vector.empty).isEmpty)
