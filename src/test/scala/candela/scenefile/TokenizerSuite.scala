package candela.scenefile

import candela.base.{FloatBuffer, RestBuffer}
import candela.diagnostics.{Problem, SceneError, Severity}
import candela.io.InputFile
import java.nio.charset.StandardCharsets.{ISO_8859_1, UTF_16, UTF_8}
import java.nio.file.Files

import candela.testing.Gzip
import org.scalatest.funsuite.AnyFunSuite

class TokenizerSuite extends AnyFunSuite:

  private def tokens(bytes: Array[Byte]): Vector[(Token, String, Int, Int)] =
    val in = Tokenizer(Source("test", bytes), None)
    in.advance()
    Vector.unfold(()): _ =>
      Option.when(in.current != Token.End):
        val token = (in.current, in.text, in.pos.line, in.pos.column)
        in.advance()
        (token, ())

  private def tokens(text: String): Vector[(Token, String, Int, Int)] = tokens(text.getBytes(UTF_8))

  test("words, texts and brackets come with their places"):
    assert(
      tokens("Shape \"sphere\"\n  \"float r\" [1 .5]") == Vector(
        (Token.Word, "Shape", 1, 1),
        (Token.Text, "sphere", 1, 7),
        (Token.Text, "float r", 2, 3),
        (Token.Open, "[", 2, 13),
        (Token.Word, "1", 2, 14),
        (Token.Word, ".5", 2, 16),
        (Token.Close, "]", 2, 18)
      )
    )

  test("nothing needs blanks around brackets and quotes"):
    assert(tokens("A\"b\"[1]C").map(_._2) == Vector("A", "b", "[", "1", "]", "C"))

  test("a comment reaches to the end of its line, also right after a word"):
    assert(tokens("# a \"b\nA#b [\nC").map(t => (t._2, t._3)) == Vector(("A", 2), ("C", 3)))

  test("a # inside of a text begins no comment"):
    assert(tokens("\"a#b\" C").map(_._2) == Vector("a#b", "C"))

  test("lines end with \\n, \\r\\n or \\r, and count the same"):
    val expected = Vector((Token.Word, "A", 1, 1), (Token.Word, "B", 3, 2), (Token.Word, "C", 4, 1))
    for end <- List("\n", "\r\n", "\r") do
      assert(tokens(List("A", "# c", " B", "C").mkString(end)) == expected)

  test("escapes in texts mean what they mean in C"):
    val text = raw""" "a\"b\\c\nd\te\rf\bg\fh\'i" """
    assert(tokens(text).map(_._2) == Vector("a\"b\\c\nd\te\rf\bg\fh'i"))

  test("unknown escapes are the character itself, with a warning"):
    var problems = Vector.empty[Problem]
    val in = Tokenizer(Source.fromText("test", raw""" "out\Cat\\é" """), None, problems :+= _)
    in.advance()
    assert(in.text == raw"outCat\é")
    assert(problems.map(p => (p.severity, p.pos.map(_.column))) == Vector((
      Severity.Warning,
      Some(6)
    )))

  test("columns count characters, not bytes"):
    assert(tokens("\"é€😀\" X").map(_._4) == Vector(1, 7))

  test("texts that are no UTF-8 are read as Latin-1"):
    assert(tokens("\"Möbel\"".getBytes(ISO_8859_1)).map(_._2) == Vector("Möbel"))

  test("a byte order mark is no part of the text"):
    assert(tokens("\ufeffA") == Vector((Token.Word, "A", 1, 1)))

  test("a list of numbers is read in one go, over lines and comments, up to what is no number"):
    val in = Tokenizer(Source.fromText("test", "[ 1 -2.5 # three\n 3e0\r\n] X"), None)
    in.advance()
    val floats = FloatBuffer()
    in.readFloats(floats, RestBuffer())
    assert(floats.drain().toVector == Vector(1f, -2.5f, 3f))
    assert(in.current == Token.Close && in.pos.line == 3)

  test("lists of any length are kept whole"):
    val values = Vector.tabulate(100000)(i => i * 0.25f)
    val in = Tokenizer(Source.fromText("test", values.mkString("[", " ", "]")), None)
    in.advance()
    val floats = FloatBuffer()
    in.readFloats(floats, RestBuffer())
    assert(floats.drain().toVector == values)

  test("a text that the line or the file ends is an error at its opening quote"):
    for text <- List("\n \"abc\nX\"", "\n \"abc", "\n \"abc\\", "\n \"abc\\\n\"") do
      val error = intercept[SceneError](tokens(text)).problems.head
      assert(error.pos.map(p => (p.line, p.column)).contains((2, 2)), text)

  test("gzipped files are unpacked, whatever their name"):
    val file = Files.createTempFile("scene", ".pbrt")
    try
      Files.write(file, Gzip.of("WorldBegin".getBytes(UTF_8)))
      assert(Source.read(InputFile.named(file)).map(s => s.text(0, s.limit)) == Right("WorldBegin"))
    finally Files.delete(file)

  test("UTF-16 is refused in so many words"):
    val file = Files.createTempFile("scene", ".pbrt")
    try
      Files.write(file, "WorldBegin".getBytes(UTF_16))
      assert(Source.read(InputFile.named(file)).left.exists(_.contains("UTF-16")))
    finally Files.delete(file)
