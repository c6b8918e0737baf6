package candela.io

import java.io.{EOFException, IOException}
import java.nio.file.{Files, Path}

import scala.util.Try

import org.scalatest.funsuite.AnyFunSuite

class CheckedFileSuite extends AnyFunSuite:
  private val text = "Größe, 漢字, and more".repeat(5000) // longer than the buffer

  private def withFile[A](body: Path => A): A =
    val file = Files.createTempFile("checked", ".bin")
    try
      CheckedFile.write(file, "test 1"): out =>
        out.int(-3)
        out.text(text)
        for i <- 0 until 20000 do out.double(i * 0.1)
        out.long(Long.MinValue)
        out.float(0.1f)
      body(file)
    finally Files.delete(file)

  private type Values = (Int, String, Double, Long, Float)

  private def values(in: CheckedInput): Values =
    (in.int(), in.text(), (0 until 20000).map(_ => in.double()).last, in.long(), in.float())

  /** By both ways to read, which must agree. */
  private def read(file: Path, mark: String = "test 1"): Values =
    val made = Try(CheckedFile.readOnce(file, mark)(values))
    val read = Try(CheckedFile.read(file, mark)(values))
    assert(made.fold(_.getMessage, identity) == read.fold(_.getMessage, identity))
    read.get

  private def reason(file: Path, mark: String = "test 1"): String =
    intercept[IOException](read(file, mark)).getMessage

  test("values are read as they were written"):
    withFile: file =>
      assert(read(file) == (-3, text, 19999 * 0.1, Long.MinValue, 0.1f))

  test("many numbers are read as they were written, wherever the buffer ends"):
    val floats = Array.tabulate(40_003)(_ * 0.1f)
    val ints = Array.tabulate(33_333)(i => i * i)
    for before <- 0 to 5 do
      val file = Files.createTempFile("checked", ".bin")
      try
        CheckedFile.write(file, "x" * before): out =>
          out.floats(floats)
          out.ints(ints)
          out.floats(Array.emptyFloatArray)
          out.int(7)
        CheckedFile.read(file, "x" * before): in =>
          assert(in.floats().sameElements(floats) && in.ints().sameElements(ints))
          assert(in.floats().isEmpty && in.int() == 7 && in.isAtEnd)
      finally Files.delete(file)

  test("a file of another kind is refused"):
    withFile: file =>
      assert(reason(file, "test 2") == "its first bytes are wrong")
      Files.write(file, Array[Byte](1, 2, 3))
      assert(reason(file) == "its first bytes are wrong")

  test("a file with any bit changed, or cut off anywhere, is refused before it is used"):
    withFile: file =>
      val whole = Files.readAllBytes(file)
      for at <- Vector(10, 1000, whole.length / 2, whole.length - 17, whole.length - 1) do
        val wrong = whole.clone
        wrong(at) = (wrong(at) ^ 4).toByte
        Files.write(file, wrong)
        assert(reason(file) == "it is damaged: its checksum is wrong", at)
      for length <- Vector(30, 1000, whole.length - 1) do
        Files.write(file, whole.take(length))
        assert(reason(file) == "it is damaged: its checksum is wrong", length)

  test("a damaged file is known while something is made of it, whatever is read"):
    withFile: file =>
      def made[A](body: CheckedInput => A) = CheckedFile.readOnce(file, "test 1")(body)
      assert(made(_.int()) == -3)
      val failed = intercept[IllegalStateException](made(_ => throw IllegalStateException("odd")))
      assert(failed.getMessage == "odd")
      val bytes = Files.readAllBytes(file)
      bytes(bytes.length / 2) = (bytes(bytes.length / 2) ^ 4).toByte
      Files.write(file, bytes)
      for body <- Seq[CheckedInput => Any](_.int(), _ => throw IllegalStateException("odd")) do
        assert(intercept[IOException](made(body)).getMessage.startsWith("it is damaged"))

  test("reading past the end fails"):
    withFile: file =>
      val _ = intercept[IOException]:
        CheckedFile.read(file, "test 1")(in => (0 until 100000).foreach(_ => in.long()))

  test("a number of values is refused before they are made, unless the file has as many"):
    val file = Files.createTempFile("checked", ".bin")
    try
      def count(number: Int, bytes: Int): Int =
        CheckedFile.write(file, "test"): out =>
          out.int(number)
          for i <- 0 until 10 do out.int(i)
        CheckedFile.read(file, "test")(_.count(bytes))
      for (number, bytes) <- Vector((0, 1000), (10, 4), (5, 8), (40, 1)) do
        assert(count(number, bytes) == number)
      for (number, bytes) <- Vector((-1, 4), (11, 4), (6, 8), (41, 1), (Int.MaxValue, 1)) do
        val _ = intercept[EOFException](count(number, bytes))
      // Beyond 2 GB, whose number of bytes is no Int
      val _ = intercept[EOFException](count(1 << 30, 8))
    finally Files.delete(file)

  test("a file tells when all of it is read"):
    withFile: file =>
      CheckedFile.read(file, "test 1"): in =>
        val _ = (in.int(), in.text())
        for _ <- 0 until 20000 do in.double(): Unit
        val _ = in.long()
        assert(!in.isAtEnd)
        val _ = in.float()
        assert(in.isAtEnd)
