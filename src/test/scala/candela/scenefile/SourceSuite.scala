package candela.scenefile

import candela.base.{FloatBuffer, IntBuffer, RestBuffer}
import candela.diagnostics.{Problem, SceneError}
import java.io.ByteArrayOutputStream
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}
import java.util.zip.GZIPOutputStream

import org.scalacheck.Gen
import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow
import org.scalatestplus.scalacheck.ScalaCheckPropertyChecks

private enum Reading:
  case Floats, Ints

class SourceSuite extends AnyFunSuite with ScalaCheckPropertyChecks:

  /** Every token with its place, or what is wrong with it; lists of numbers as their values.
    *
    * @param reading of lists
    * @param atOnce  else number by number
    */
  private def tokens(
      source: Source,
      reading: Reading = Reading.Floats,
      atOnce: Boolean = true
  ): Vector[String] =
    val in = Tokenizer(source, None)
    val floats = FloatBuffer()
    val ints = IntBuffer()
    def readList(): Unit = reading match
      case Reading.Floats if atOnce => in.readFloats(floats, RestBuffer())
      case Reading.Ints if atOnce => in.readInts(ints)
      case _ =>
        in.advance()
        while if reading == Reading.Ints then in.readInt(ints) else in.readFloat(floats) do
          in.advance()
    def readDoubles(into: Array[Double]): Int =
      if atOnce then in.readDoubles(into)
      else
        val one = new Array[Double](1)
        into.indices.takeWhile(i => in.readDoubles(one) == 1 && { into(i) = one(0); true }).size
    def step(): String =
      try
        val doubles = new Array[Double](3)
        if in.current == Token.Open then readList()
        else if readDoubles(doubles) == 0 then in.advance()
        val lists = s"${floats.drain().mkString(",")} ${ints.drain().mkString(",")}"
        val numbers = s"${doubles.mkString(",")} $lists ${in.sawFraction}"
        s"${in.pos} ${in.current} ${in.text} ${in.isNumber} $numbers"
      catch case e: SceneError => e.problems.mkString
    Iterator.continually(step()).takeWhile(_ => in.current != Token.End).toVector

  private val pieces = Gen.oneOf(
    List(
      "Shape", "\"float x\"", "[ 1 2.5\n-3e2 ]", "[0.25 .5", "]", "# it\r", "\r\n", "\r", "\n"
    ) ++
      List("\t ", " ", "\"é€😀", "\"a\\\"b\"", "\\", "1e", "123456789.123456789 ", "é", "\"")
  )

  test("however small the window, tokens, numbers, places and errors are the same"):
    forAll(Gen.listOf(pieces).map(_.mkString), Gen.choose(1, 90)): (text, room) =>
      val bytes = text.getBytes(UTF_8)
      val whole = tokens(Source("test", bytes))
      assert(tokens(Source.windowed("test", bytes, room)) == whole)

  test("numbers of a list that are read at once are those that are read one by one"):
    val list = Gen.oneOf(pieces, Gen.const("[ "), Gen.const("7 "), Gen.const("-3000000000 "))
    forAll(Gen.listOf(list).map(_.mkString), Gen.choose(1, 90), Gen.oneOf(Reading.values.toSeq)):
      (text, room, reading) =>
        def found(atOnce: Boolean) =
          tokens(Source.windowed("test", text.getBytes(UTF_8), room), reading, atOnce)
        assert(found(atOnce = true) == found(atOnce = false))

  private def withFile[A](bytes: Array[Byte])(use: Path => A): A =
    val file = Files.createTempFile("scene", ".pbrt")
    try
      Files.write(file, bytes)
      use(file)
    finally Files.delete(file)

  private def zipped(write: GZIPOutputStream => Unit): Array[Byte] =
    val bytes = ByteArrayOutputStream()
    val zip = GZIPOutputStream(bytes)
    write(zip)
    zip.close()
    bytes.toByteArray

  private def problem(file: Path): Problem =
    intercept[SceneError](Parser.parse(file)).problems.head

  test("files larger than the window keep their numbers, places and excerpts"):
    val lines = Vector.tabulate(60000)(i => s"${i * 0.5} # é $i")
    val long = "1 " * 200000
    val text = lines.mkString("WorldBegin Shape \"a\" \"float x\" [ ", "\n", s"\n]\n$long [ # here")
    withFile(text.getBytes(UTF_8)): file =>
      val problem = this.problem(file)
      assert(problem.pos.exists(at => (at.line, at.column) == (60002, 1)), problem)
    val late = text.replace(long, "Shape \"b\" \"float y\" [ " + long)
    withFile(late.getBytes(UTF_8)): file =>
      val problem = this.problem(file)
      assert(problem.pos.exists(at => (at.line, at.column) == (60002, 400024)))
      assert(problem.excerpt.exists(e => e.startsWith("…") && e.endsWith("1  [ # here")))
    withFile((lines.mkString(
      "WorldBegin Shape \"a\" \"float x\" [ ",
      "\n",
      "\n]"
    )).getBytes(UTF_8)): file =>
      val floats = Parser.parse(file).shapes.head.shape.params.head.floats
      assert(floats.toVector == Vector.tabulate(60000)(_ * 0.5f))

  test("a packed file that is cut short is an error where it ends"):
    val bytes = zipped(_.write("WorldBegin\n  Shape \"sphere\"\n".repeat(20000).getBytes(UTF_8)))
    withFile(bytes.take(bytes.length / 2)): file =>
      assert(problem(file).message.startsWith("can't read further: "))
      assert(problem(file).pos.nonEmpty)

  test("a small file that unpacks without end is refused", Slow):
    val blanks = Array.fill[Byte](1 << 20)(' ')
    val bytes = zipped(zip => for _ <- 0 until 100 do zip.write(blanks))
    withFile(bytes): file =>
      assert(
        problem(file).message.matches("can't read further: decompresses to more than \\d+ times.*")
      )

  test("a word that does not end is refused before it fills the memory"):
    withFile(("WorldBegin\n " + "a" * 3000000).getBytes(UTF_8)): file =>
      val problem = this.problem(file)
      assert(problem.message == "can't read further: token longer than 1 MB")
      assert(problem.pos.exists(at => (at.line, at.column) == (2, 2)))

  test("an error in a line that begins within a character has an excerpt"):
    val bytes = "WorldBegin\n".getBytes(UTF_8) ++ Array[Byte](-128, -65) ++ " x\n".getBytes(UTF_8)
    withFile(bytes)(file => assert(problem(file).excerpt.nonEmpty))
