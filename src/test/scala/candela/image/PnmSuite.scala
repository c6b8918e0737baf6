package candela.image

import candela.diagnostics.Severity
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

import candela.scenefile.Dialect
import candela.testing.SceneTexts

final class PnmSuite extends AnyFunSuite:

  private def file(folder: Path, name: String, header: String, values: Int*): Path =
    val bytes = header.getBytes("ISO-8859-1") ++ values.map(_.toByte)
    Files.write(folder.resolve(name), bytes)

  private def read(header: String, values: Int*): Image = Samples.inFolder: folder =>
    ImageFiles.read(file(folder, "a.pnm", header, values*))

  private def assertSame(found: Image, wanted: Double*): Unit =
    assert(found.data.toSeq == wanted.map(_.toFloat), found.channelNames): Unit

  test("the maximum is white, whatever it is"):
    assertSame(read("P6 1 1 1\n", 0, 1, 1), 0, 1, 1)
    assertSame(read("P6 1 1 127\n", 0, 64, 127), 0, 64f / 127, 1)
    assertSame(read("P6 1 1 255\n", 0, 64, 255), 0, 64f / 255, 1)
    assertSame(read("P6 1 1 1023\n", 0, 0, 2, 1, 3, 255), 0, 513f / 1023, 1)
    assertSame(read("P6 1 1 65535\n", 0, 0, 128, 1, 255, 255), 0, 32769f / 65535, 1)
    assertSame(read("P5 3 1 127\n", 0, 64, 127), 0, 64f / 127, 1)
    assertSame(read("P5 2 1 65535\n", 128, 1, 255, 254), 32769f / 65535, 65534f / 65535)
    assert(read("P5 1 1 1\n", 1).channelNames == Vector("Y"))

  test("numerals say the same as bytes"):
    assertSame(read("P3\n1 1\n127\n0 64\n127\n"), 0, 64f / 127, 1)
    assertSame(read("P3 1 1 65535 0 32769 65535"), 0, 32769f / 65535, 1)
    assertSame(read("P2 3 1 1023 0 513 1023"), 0, 513f / 1023, 1)
    assertSame(read("P2 2 1 255 51 255"), 51f / 255, 1)

  test("the ones of bitmaps are black; rows of bytes are padded"):
    assertSame(read("P1 3 2\n010\n1 0 1\n"), 1, 0, 1, 0, 1, 0)
    assertSame(
      read("P4 9 2\n", 0x80, 0x80, 0x01, 0),
      Vector.tabulate(18)(i =>
        if Set(0, 8, 16)(i) then 0.0 else 1.0
      )*
    )

  test("comments may stand between the words of the header, values above the maximum are white"):
    assertSame(read("P6 # made by hand\n1 # width\n1\n#\n10\n", 5, 11, 255), .5, 1, 1)

  test("what is no such file is refused with the reason"):
    val wrong = Vector(
      "P6 2 2 255\n" -> "2×2 pixels need 12 bytes, found 3",
      "P6 2 2 70000\n" -> "expected its maximum, at most 65535, found `70000",
      "P6 0 2 255\n" -> "expected sizes and a maximum above 0, found 0 2 255",
      "P3 1 1 255 1 2" -> "expected its value, at most 65535, found ``",
      "P3 1 1 255 1 x 3 " -> "expected its value, at most 65535, found `x 3",
      "P5 99999 99999 255\n" -> "pixels need"
    )
    for (header, message) <- wrong do
      val binary = header.endsWith("\n")
      val error = intercept[ImageError](read(header, (if binary then Seq(1, 2, 3) else Nil)*))
      assert(error.getMessage.contains(message), header)

  test("a scene's map whose white is not 255 comes with a warning: pbrt-v4 reads another image"):
    def said(header: String) = Samples.inFolder: folder =>
      val _ = file(folder, "a.ppm", header, 1, 2, 3)
      val text =
        """WorldBegin
          |Texture "t" "spectrum" "imagemap" "string filename" "a.ppm"
          |Material "diffuse" "texture reflectance" "t"
          |LightSource "infinite"
          |Shape "sphere"""".stripMargin
      val problems = SceneTexts.problems(text, Dialect.V4, folder)
      problems.filter(_.severity == Severity.Warning).map(_.message).mkString
    val most = "a.ppm: its values are at most 127, which is white; pbrt-v4 takes 255 for white"
    assert(said("P6 1 1 127\n").endsWith(most))
    assert(said("P3 1 1 255 1 2 3 ").contains("pbrt-v4 can't read it"))
    assert(!said("P6 1 1 255\n").contains("pbrt-v4"))
