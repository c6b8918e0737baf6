package candela.cli.commands

import candela.cli.Captured
import candela.cli.options.Limit
import candela.image.{Image, ImageFiles, ImageWindow, WriteOptions}
import candela.testing.FlatImages.flat
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class CompareCommandSuite extends AnyFunSuite:

  private def run(args: String*): (Int, Captured) = Captured.run("compare" +: args*)

  test("images of different parts of one are not the same: a warning, and an error of average"):
    TempFolder.use: folder =>
      def crop(name: String, x: Int) =
        val file = folder.resolve(name)
        val window = Some(ImageWindow(x, 0, 8, 4))
        ImageFiles.write(file, Image.rgb(4, 4), options = WriteOptions(window = window))
        s"$file"
      val (left, right, same) = (crop("a.exr", 0), crop("b.exr", 4), crop("c.exr", 0))
      val mean = folder.resolve("mean.exr")
      val warned = run(left, right)
      assert(warned._1 == 0 && warned._2.err.contains("not the same part"), warned._2.err)
      assert(!run(left, same)._2.err.contains("part"))
      def average(files: String*) = Captured.run(("average" +: files) ++ Seq("-o", s"$mean")*)
      assert(average(left, right)._1 == 1 && !Files.exists(mean))
      assert(average(left, same)._1 == 0)
      assert(ImageFiles.about(mean)._1.contains(ImageWindow(0, 0, 8, 4)))

  test("equal images have no error"):
    TempFolder.use: folder =>
      val a = flat(folder.resolve("a.exr"), 0.5f)
      val (code, captured) = run(a, a, "--max-relmse", "0")
      assert(code == 0)
      assert(captured.out.linesIterator.toVector.take(8) == Vector(
        "error         0 %",
        "MSE           0.000",
        "RMSE          0.000",
        "MAE           0.000",
        "relative MSE  0.000",
        "PSNR          infinite",
        "FLIP          0.000",
        "mean ratio    R 1.0000  G 1.0000  B 1.0000"
      ))

  test("all figures are printed, of the first image against the second"):
    TempFolder.use: folder =>
      val a = flat(folder.resolve("a.exr"), 0.75f)
      val b = flat(folder.resolve("b.exr"), 0.5f)
      val (code, captured) = run(a, b)
      assert(code == 0)
      val lines = captured.out.linesIterator.toVector
      assert(lines(0) == "error         49 %")
      assert(lines(1) == "MSE           0.06250")
      assert(lines(2) == "RMSE          0.2500")
      assert(lines(3) == "MAE           0.2500")
      // (0.25 / 0.51)²
      assert(lines(4) == "relative MSE  0.2403")
      assert(lines(5).startsWith("PSNR") && lines(5).endsWith(" dB"))
      assert(lines(6).startsWith("FLIP          0."))
      assert(lines(7) == "mean ratio    R 1.5000  G 1.5000  B 1.5000")
      assert(lines(8) == "largest       0.2500 in R at (0, 0)")

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
      assert(captured.err == "NaN or infinite in 1 pixel\n")

  test("images of different size, and files that are not there, are bad input"):
    TempFolder.use: folder =>
      val a = flat(folder.resolve("a.exr"), 0.5f)
      val b = flat(folder.resolve("b.exr"), 0.5f, width = 5)
      val (code, captured) = run(a, b)
      assert(code == 1)
      assert(captured.err.startsWith("error: ") && captured.err.contains("--resolution 5x"))
      assert(run(a, folder.resolve("none.exr").toString)._1 == 1)

  test("a transparent picture has the colours of its rendering"):
    TempFolder.use: folder =>
      val (exr, png) = (folder.resolve("a.exr"), folder.resolve("a.png"))
      val names = Image.RgbNames :+ "A"
      ImageFiles.write(exr, Image(1, 1, names, Array(0.1f, 0.2f, 0.25f, 0.5f)))
      assert(Captured.run("image", s"$exr", "--outfile", s"$png")._1 == 0)
      // Half a step of 8 bits is 0.2 % of what is bright
      val (code, captured) = run(s"$png", s"$exr", "--max-relmse", "1e-4")
      assert(code == 0, captured.out + captured.err)

  private def spotted(path: Path): String =
    val image = Image.rgb(8, 4)
    java.util.Arrays.fill(image.data, 0.5f)
    image.data(3 * (1 * 8 + 2) + 1) = 1f // green at (2, 1)
    ImageFiles.write(path, image)
    path.toString

  test("every limit can fail, and says by how much"):
    TempFolder.use: folder =>
      val a = spotted(folder.resolve("a.exr"))
      val b = flat(folder.resolve("b.exr"), 0.5f, 8, 4)
      for (option, _, _) <- Limit.all do
        val isLeast = option.startsWith("min")
        val (strict, loose) = if isLeast then ("99", "1") else ("1e-9", "1")
        val (code, captured) = run(a, b, s"--$option", strict)
        assert(code == 1, option)
        assert(captured.err.contains(s"--$option"), option)
        assert(run(a, b, s"--$option", loose)._1 == 0, option)

  test("a crop leaves the rest of the picture out, and must lie in it"):
    TempFolder.use: folder =>
      val a = spotted(folder.resolve("a.exr"))
      val b = flat(folder.resolve("b.exr"), 0.5f, 8, 4)
      assert(!run(a, b)._2.out.contains("\nMSE           0.000"))
      val (_, same) = run(a, b, "--crop", "0,8,2,4")
      assert(same.out.contains("\nMSE           0.000"))
      val (code, outside) = run(a, b, "--crop", "0,9,2,4")
      assert(code == 1)
      assert(outside.err.contains("window x 0 to 9, y 2 to 4 is outside the image of 8×4 pixels"))

  test("channels can be told apart, and chosen"):
    TempFolder.use: folder =>
      val a = spotted(folder.resolve("a.exr"))
      val b = flat(folder.resolve("b.exr"), 0.5f, 8, 4)
      val lines = run(a, b, "--per-channel")._2.out.linesIterator.toVector
      val green = lines.find(_.startsWith("G ")).get.split(" +").toVector
      // one of 32 pixels is off by 1/2
      assert(green(1) == "0.007813" && green.last == "1.0313")
      assert(run(a, b, "--channels", "R,B")._2.out.contains("\nMSE           0.000"))
      assert(run(
        a,
        b,
        "--channels",
        "Z"
      )._2.err.contains("the image has no channel Z; known: R, G, B"))

  test("a crop and the whole image are told, with the words that cut it"):
    TempFolder.use: folder =>
      def file(name: String) = folder.resolve(name).toString
      ImageFiles.write(folder.resolve("a.exr"), Image.rgb(8, 6))
      val words = Vector("image", file("a.exr"), "--crop", "2,6,1,4", "-o", file("b.exr"))
      assert(Captured.run(words*)._1 == 0)
      val window = WriteOptions(window = Some(ImageWindow(2, 1, 8, 6)))
      ImageFiles.write(folder.resolve("c.exr"), Image.rgb(4, 3), options = window)
      for pair <- Vector(Vector("a.exr", "c.exr"), Vector("c.exr", "a.exr")) do
        val (code, captured) = Captured.run(("compare" +: pair.map(file))*)
        val cure = s"`candela image ${file("a.exr")} --crop 2,6,1,4`"
        assert(code == 1 && captured.err.contains(cure), captured.err)
      assert(Captured.run("compare", file("b.exr"), file("c.exr"))._1 == 0)

  test("difference and heat map show where the pictures differ"):
    TempFolder.use: folder =>
      val a = spotted(folder.resolve("a.exr"))
      val b = flat(folder.resolve("b.exr"), 0.5f, 8, 4)
      val (difference, heat) = (folder.resolve("d.exr"), folder.resolve("h.png"))
      val numbers = folder.resolve("h.exr")
      val words = Vector(a, b, "--difference", difference.toString, "--heatmap", heat.toString) ++
        Vector("--heatmap-metric", "mae", "--heatmap-max", "0.2")
      val (code, captured) = run(words*)
      assert(code == 0)
      assert(captured.out.contains("heat map      MAE from 0 to 0.2000"))
      val d = ImageFiles.read(difference)
      assert(d(2, 1, 1) == 0.5f && d.data.sum == 0.5f)
      val h = ImageFiles.read(heat)
      // The error is 1/6 of a limit of 0.2, near the pale end; elsewhere nearly black.
      assert(h(2, 1, 0) > 0.9f && h(3, 1, 0) < 0.02f)
      assert(run(a, b, "--heatmap", numbers.toString, "--heatmap-metric", "mae")._1 == 0)
      assert(Math.abs(ImageFiles.read(numbers)(2, 1, 0) - 0.5f / 3) < 1e-6f)

  test("a folder is compared with its references, and what has none is named"):
    TempFolder.use: folder =>
      val (images, references) = (folder.resolve("images"), folder.resolve("references"))
      java.nio.file.Files.createDirectories(images)
      java.nio.file.Files.createDirectories(references)
      for (name, value) <- Vector("one" -> 0.75f, "two" -> 0.5f, "three" -> 0.5f) do
        val _ = flat(images.resolve(s"$name.exr"), value)
      for name <- Vector("one", "two") do
        val _ = flat(references.resolve(s"$name.exr"), 0.5f)
      val (code, captured) = run(images.toString, references.toString)
      assert(code == 1)
      assert(captured.err.contains("three.exr: no reference"))
      val rows = captured.out.linesIterator.map(_.split(" +").toVector).toVector
      assert(rows.map(_.head) == Vector("image", "one.exr", "two.exr", "mean"))
      assert(rows(1)(3) == "0.06250" && rows(2)(3) == "0.000" && rows(3)(3) == "0.03125")
      val one = references.resolve("one.exr").toString
      val limited = run(images.toString, one, "--max-relmse", "0.1")
      assert(limited._1 == 1)
      assert(limited._2.err.startsWith("one.exr: relative MSE 0.2403 is above"))
