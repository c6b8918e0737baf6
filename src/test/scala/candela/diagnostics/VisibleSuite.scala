package candela.diagnostics

import org.scalatest.funsuite.AnyFunSuite

class VisibleSuite extends AnyFunSuite:

  test("text without control characters stays as it is"):
    for text <- Vector("", "plain", "Grüße, 日本語, 😀", "a\tb", "क्\u200dष, می\u200cخواهم") do
      assert(Visible.line(text) == text)
      assert(Visible.text(text) == text)

  test("control characters are pictures of one column"):
    assert(Visible.line("\u001b[31mred\u0007") == "␛[31mred␇")
    assert(Visible.line("\u0000\r\u007f\b") == "␀␍␡␈")

  test("line ends are text's, and none of a line's"):
    assert(Visible.text("a\nb\r\nc") == "a\nb␍\nc")
    assert(Visible.line("a\nb") == "a␊b")

  test("C1 controls, marks of direction, line separators and half pairs are numbers"):
    assert(Visible.line("\u009b31m\u0085") == "<U+009B>31m<U+0085>")
    for c <- Vector(0x202a, 0x202e, 0x2066, 0x2069, 0x200e, 0x200f, 0x061c, 0x2028, 0x2029, 0xfeff)
    do assert(Visible.line(Character.toString(c)) == f"<U+$c%04X>")
    assert(Visible.line("a\ud83d b") == "a<U+D83D> b")
    assert(Visible.line("\ude00") == "<U+DE00>")
    assert(Visible.line(Character.toString(0xe0041)) == "<U+E0041>")

  test("what is visible stays as it is"):
    val once = Visible.line("\u001b\u009b\u202e\n")
    assert(Visible.line(once) == once)
