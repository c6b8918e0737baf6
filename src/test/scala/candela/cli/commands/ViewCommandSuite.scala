package candela.cli.commands

import candela.cli.Captured
import candela.color.Srgb
import candela.image.ImageFiles
import candela.testing.FlatImages.flat
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class ViewCommandSuite extends AnyFunSuite:

  private def run(args: String*): (Int, Captured) = Captured.run("view" +: args*)

  test("one image is written as a picture, by its tone curve and exposure"):
    TempFolder.use: folder =>
      val a = flat(folder.resolve("a.exr"), 2f, 40, 20)
      val out = folder.resolve("a.png")
      val (code, captured) = run(a, "--outfile", out.toString, "--exposure", "-3", "--bits", "16")
      assert(code == 0 && captured.out == s"wrote $out  40x20\n")
      val read = ImageFiles.read(out).linear
      assert((read.width, read.height) == (40, 20))
      assert(Math.abs(read(3, 3, 0) - 0.25f) < 1e-4f)
      assert(Files.readString(out, java.nio.charset.StandardCharsets.ISO_8859_1)
        .contains("-3.00 stops"))

  test("several images become a contact sheet, each with its own auto exposure"):
    TempFolder.use: folder =>
      val images = Vector(0.01f, 5f, 300f).zipWithIndex.map: (value, i) =>
        flat(folder.resolve(s"$i.exr"), value, 40, 20)
      val out = folder.resolve("sheet.png").toString
      val (code, _) =
        run(images ++ Seq("--outfile", out, "--exposure", "auto", "--columns", "3")*)
      assert(code == 0)
      val read = ImageFiles.read(Path.of(out)).linear
      // Half a code of 8 bits: 0.0016 of light at 0.18
      val grey = read.data.count(v => Math.abs(v - 0.18f) < 2e-3f)
      assert(grey == 3 * 40 * 20 * 3)

  test("without a file it needs a terminal, or a protocol by name"):
    TempFolder.use: folder =>
      val a = flat(folder.resolve("a.exr"), 0.5f, 40, 20)
      val (code, captured) = run(a)
      assert(code == 1 && captured.err.contains("--thumbnail kitty, iterm, sixel or blocks"))
      val (shown, terminal) = run(a, "--thumbnail", "blocks")
      val gray = Srgb.encode8(0.5f)
      assert(shown == 0 && terminal.out.contains(s"38;2;$gray;$gray;${gray}m"))

  test("linear formats are refused: nothing to view is in them"):
    TempFolder.use: folder =>
      val a = flat(folder.resolve("a.exr"), 0.5f, 40, 20)
      val out = folder.resolve("b.exr")
      val pictures = ".png, .jpg, .qoi or .tga"
      val (code, captured) = run(a, "--outfile", out.toString)
      assert(code == 1 && captured.err == s"error: `view` writes $pictures, found `$out` [E0106]\n")
      assert(!Files.exists(out))
