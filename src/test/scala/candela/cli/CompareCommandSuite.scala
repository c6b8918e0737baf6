package candela.cli

import candela.image.{Image, ImageFiles}

import java.nio.file.Path

import org.scalatest.funsuite.AnyFunSuite

class CompareCommandSuite extends AnyFunSuite:

  private def flat(path: Path, value: Float, width: Int = 4): String =
    val image = Image.rgb(width, 2)
    java.util.Arrays.fill(image.data, value)
    ImageFiles.write(path, image)
    path.toString

  private def run(args: String*): (Int, Captured) =
    val captured = Captured()
    (Main.run("compare" +: args, captured.terminal), captured)

  test("equal images have no error"):
    TempFolder.use: folder =>
      val a = flat(folder.resolve("a.exr"), 0.5f)
      val (code, captured) = run(a, a, "--max-relmse", "0")
      assert(code == 0)
      assert(captured.out.linesIterator.toVector.take(4) == Vector(
        "MSE           0.000",
        "relative MSE  0.000",
        "PSNR          infinite",
        "mean ratio    R 1.0000  G 1.0000  B 1.0000"
      ))

  test("all figures are printed, of the first image against the second"):
    TempFolder.use: folder =>
      val a = flat(folder.resolve("a.exr"), 0.75f)
      val b = flat(folder.resolve("b.exr"), 0.5f)
      val (code, captured) = run(a, b)
      assert(code == 0)
      val lines = captured.out.linesIterator.toVector
      assert(lines(0) == "MSE           0.06250")
      // (0.25 / 0.51)²
      assert(lines(1) == "relative MSE  0.2403")
      assert(lines(2).startsWith("PSNR") && lines(2).endsWith(" dB"))
      assert(lines(3) == "mean ratio    R 1.5000  G 1.5000  B 1.5000")
      assert(lines(4) == "largest       0.2500 in R at (0, 0)")

  test("above --max-relmse the exit code is 1, and the message says why"):
    TempFolder.use: folder =>
      val a = flat(folder.resolve("a.exr"), 0.75f)
      val b = flat(folder.resolve("b.exr"), 0.5f)
      val (code, captured) = run(a, b, "--max-relmse", "0.2")
      assert(code == 1)
      assert(captured.err == "relative MSE 0.2403 is above --max-relmse 0.2\n")
      assert(run(a, b, "--max-relmse", "0.25")._1 == 0)

  test("an image with NaN does not pass"):
    TempFolder.use: folder =>
      val image = Image.rgb(4, 2)
      image.data(5) = Float.NaN
      val a = folder.resolve("a.exr")
      ImageFiles.write(a, image)
      val b = flat(folder.resolve("b.exr"), 0f)
      val (code, captured) = run(a.toString, b, "--max-relmse", "1")
      assert(code == 1)
      assert(captured.out.contains("skipped       1 pixel, NaN or infinite"))
      assert(captured.err == "1 pixel can't be compared\n")

  test("images of different size, and files that are not there, are bad input"):
    TempFolder.use: folder =>
      val a = flat(folder.resolve("a.exr"), 0.5f)
      val b = flat(folder.resolve("b.exr"), 0.5f, width = 5)
      val (code, captured) = run(a, b)
      assert(code == 1)
      assert(captured.err.startsWith("error: "))
      assert(run(a, folder.resolve("none.exr").toString)._1 == 1)
