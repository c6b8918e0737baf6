package candela.cli.commands

import candela.cli.Captured
import candela.image.{Image, ImageFiles}
import candela.testing.TempFolder

import java.nio.file.{Files, Path}
import java.util.SplittableRandom

import org.scalatest.funsuite.AnyFunSuite

class BiasComparisonSuite extends AnyFunSuite:

  private def run(args: String*): (Int, Captured) = Captured.run("compare" +: "--bias" +: args*)

  /** Writes images of 24 × 16 pixels with 10 % of noise; returns their folder. */
  private def images(folder: Path, count: Int, seed: Int, brightness: Double = 1): String =
    val random = SplittableRandom(seed)
    val _ = Files.createDirectories(folder)
    for i <- 1 to count do
      val image = Image.rgb(24, 16)
      for at <- image.data.indices do
        image.data(at) = (brightness * (1 + 0.35 * (random.nextDouble() - 0.5))).toFloat
      ImageFiles.write(folder.resolve(s"run-$i.exr"), image)
    folder.toString

  test("equal programs pass, and the figures say how"):
    TempFolder.use: folder =>
      val a = images(folder.resolve("a"), 6, 1)
      val b = images(folder.resolve("b"), 6, 2)
      val (code, captured) = run(a, b)
      assert(code == 0, captured.err)
      val lines = captured.out.linesIterator.toVector
      assert(lines(0).startsWith("bias          none found: p = "))
      assert(lines(1) == "compared      6 images and 6 images")
      assert(lines(2).startsWith("whole image   R ") && lines(2).contains(" ± 0.00"))
      assert(lines(5).startsWith("least alike   "))

  test("a bias has exit code 1, is named, and shows in the map"):
    TempFolder.use: folder =>
      val a = images(folder.resolve("a"), 6, 1, brightness = 1.05)
      val b = images(folder.resolve("b"), 6, 2)
      val (png, exr) = (folder.resolve("p.png"), folder.resolve("p.exr"))
      val (code, captured) = run(a, b, "--heatmap", png.toString)
      assert(code == 1)
      assert(captured.out.startsWith("bias          found: p = "))
      assert(captured.out.contains("\ndifferent     "))
      assert(captured.out.contains("heat map      p-value from 1 to 0.0001, in "))
      assert(run(a, b, "--heatmap", exr.toString)._1 == 1)
      val map = ImageFiles.read(exr)
      assert(map.width == 24 && map.data.forall(p => p >= 0 && p <= 1))
      assert(map.data.count(_ < 0.05) > 24 * 16)
      assert(ImageFiles.read(png).width == 24)
      assert(run(a, b, "--significance", "1e-30")._1 == 0)

  test("images that are partly no numbers have exit code 1, and are named"):
    TempFolder.use: folder =>
      val a = folder.resolve("a")
      val _ = images(a, 6, 1)
      val b = images(folder.resolve("b"), 6, 2)
      val first = a.resolve("run-1.exr")
      val image = ImageFiles.read(first)
      image.data(0) = Float.NaN
      ImageFiles.write(first, image)
      val (code, captured) = run(a.toString, b)
      assert(code == 1)
      assert(captured.out.startsWith("bias          none found"), captured.out)
      assert(captured.err.contains("NaN or infinite in 1 tile"), captured.err)

  test("sets are folders, names between commas, and patterns"):
    TempFolder.use: folder =>
      val a = images(folder.resolve("a"), 4, 1)
      val b = images(folder.resolve("b"), 4, 2)
      val whole = run(a, b)._2.out
      assert(run(
        s"$a/run-*.exr",
        (1 to 4).map(i => s"$b/run-$i.exr").mkString(",")
      )._2.out == whole)

  test("a single image needs its own error, for which the layer variance does not do"):
    TempFolder.use: folder =>
      val a = images(folder.resolve("a"), 2, 1)
      val b = images(folder.resolve("b"), 2, 2)
      val (code, captured) = run(s"$a/run-1.exr", b)
      assert(code == 1)
      assert(captured.err.contains("a single image needs its own error"))
      val names = Vector("R", "G", "B", "Variance.R", "Variance.G", "Variance.B", "samples")
      val file = folder.resolve("c.exr")
      ImageFiles.write(file, Image(24, 16, names, Array.fill(24 * 16 * names.size)(1f)))
      val (refused, said) = run(s"$file", b)
      assert(refused == 1 && said.err.contains("leaves out samples of the sky"), said.err)

  test("sets without images, images that are the same, and idle options are told"):
    TempFolder.use: folder =>
      val a = images(folder.resolve("a"), 2, 1)
      val none = run(s"$a/*.png", a)
      assert(none._1 == 1 && none._2.err.contains("expected images, found none"))
      val b = images(folder.resolve("b"), 2, 2)
      val same = run(b, s"$a/*.exr,${copy(Path.of(a))}")
      assert(same._1 == 1 && same._2.err.contains("are identical"))
      assert(run(a, a, "--max-mse", "1")._1 == 2)
      assert(run(a, a, "--difference", "d.exr")._1 == 2)
      assert(run(a, a, "--significance", "2")._1 == 2)

  test("images of both sets, and images named twice, are told"):
    TempFolder.use: folder =>
      val a = images(folder.resolve("a"), 3, 1)
      val b = images(folder.resolve("b"), 3, 2)
      val common = s"`$a/run-1.exr` and 2 more images are in both sets"
      val same = run(a, a)
      assert(same._1 == 1 && same._2.err.contains(common), same._2.err)
      val one = run(a, s"$b/run-1.exr,$a/../a/run-2.exr")
      assert(one._1 == 1 && one._2.err.contains(s"`$a/run-2.exr` is in both"), one._2.err)
      val twice = run(b, s"$a/run-1.exr,$a/run-1.exr")
      assert(twice._1 == 1 && twice._2.err.contains(s"`$a/run-1.exr` is given twice"))

  test("a missing file or folder is told with a name like it"):
    TempFolder.use: folder =>
      val a = images(folder.resolve("a"), 2, 1)
      val _ = images(folder.resolve("b"), 2, 2)
      val bias = run(a, folder.resolve("bb").toString)
      assert(bias._1 == 1 && bias._2.err.contains("did you mean `b`?"), bias._2.err)
      assert(bias._2.err.contains("there is no such file [E0104]"))
      val two = Captured.run("compare", s"$a/run-1.exr", s"$a/run-2.exrr")
      assert(two._1 == 1 && two._2.err.contains("did you mean `run-2.exr`?"), two._2.err)

  private def copy(folder: Path): String =
    val to = folder.resolveSibling("copy.exr")
    Files.copy(folder.resolve("run-1.exr"), to).toString
