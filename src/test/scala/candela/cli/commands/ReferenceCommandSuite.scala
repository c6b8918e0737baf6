package candela.cli.commands

import candela.cli.Captured
import candela.image.{Image, ImageFiles}
import candela.measure.ErrorLayer
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

class ReferenceCommandSuite extends AnyFunSuite:

  private def run(args: String*): (Int, Captured) = Captured.run("reference" +: args*)

  /** A matte ball under an emitter, of 12 × 8 pixels. */
  private def scene(folder: Path): String =
    val text =
      """Film "rgb" "integer xresolution" 12 "integer yresolution" 8
        |LookAt 0 0 -4  0 0 0  0 1 0
        |Camera "perspective" "float fov" 40
        |Sampler "independent" "integer pixelsamples" 4
        |Integrator "path" "integer maxdepth" 3
        |WorldBegin
        |AttributeBegin
        |  AreaLightSource "diffuse" "rgb L" [ 8 8 8 ]
        |  Translate 0 3 -1
        |  Shape "sphere" "float radius" 0.7
        |AttributeEnd
        |LightSource "infinite" "rgb L" [ .3 .3 .4 ]
        |Material "diffuse" "rgb reflectance" [ .6 .5 .4 ]
        |Shape "sphere"
        |""".stripMargin
    Files.writeString(folder.resolve("ball.pbrt"), text).toString

  private def facts(file: Path): Map[String, String] = ImageFiles.facts(file).toMap

  test("a reference has its own error, in a layer and in words"):
    TempFolder.use: folder =>
      val file = folder.resolve("r.exr")
      val (code, captured) =
        run(scene(folder), "--error", "4%", "--spp", "4", "--outfile", file.toString)
      assert(code == 0, captured.err)
      val about = facts(file)
      val runs = about("runs").toInt
      assert(runs >= 8 && about("samplesPerPixel").toInt == 4 * runs)
      val error = about("relativeError").toDouble
      assert(error > 0.005 && error <= 0.04)
      assert(captured.out.contains(s"$runs runs of 4 samples per pixel, relative error "))
      val image = ImageFiles.read(file)
      assert(image.channelNames.toSet == (Image.RgbNames ++ ErrorLayer.Channels).toSet)
      // That of the layer is relative to the image alone, and so near to it
      val own = Math.sqrt(ErrorLayer.error(image).get.relativeMse)
      assert(Math.abs(own / error - 1) < 0.05)
      assert(Files.list(folder).count == 2) // no films are left

  test("a reference that goes on is the one that was made at once, byte for byte", Slow):
    TempFolder.use: folder =>
      val (a, b) = (folder.resolve("a.exr"), folder.resolve("b.exr"))
      val ball = scene(folder)
      assert(run(ball, "--error", "1%", "--spp", "8", "--outfile", a.toString)._1 == 0)
      assert(run(ball, "--error", "5%", "--spp", "8", "--outfile", b.toString)._1 == 0)
      val more = run(ball, "--error", "1%", "--spp", "8", "--outfile", b.toString)
      assert(more._1 == 0 && more._2.err.contains(s"continuing $b: "))
      assert(facts(a)("runs").toInt > 8)
      assert(Files.readAllBytes(a).sameElements(Files.readAllBytes(b)))
      val kept = run(ball, "--error", "1%", "--spp", "8", "--outfile", b.toString)
      assert(kept._1 == 0 && kept._2.out.startsWith(s"kept $b"))

  test("the file of another scene, of other options, or another image is not overwritten"):
    TempFolder.use: folder =>
      val file = folder.resolve("r.exr").toString
      val ball = scene(folder)
      def made(args: String*) = run((ball +: args) ++ Vector("--error", "50%", "--outfile", file)*)
      assert(made("--spp", "2")._1 == 0)
      val other = made("--spp", "4")
      assert(other._1 == 1 && other._2.err.contains("is a reference of another scene"))
      ImageFiles.write(Path.of(file), Image.rgb(12, 8))
      val image = made("--spp", "2")
      assert(image._1 == 1 && image._2.err.contains("is an image, not a reference"))

  test("compare tells the reference's own error, and the image's without it"):
    TempFolder.use: folder =>
      val file = folder.resolve("r.exr").toString
      val ball = scene(folder)
      assert(run(ball, "--error", "5%", "--spp", "4", "--outfile", file)._1 == 0)
      val image = folder.resolve("i.exr").toString
      assert(Captured.run(ball, "--spp", "1", "--outfile", image)._1 == 0)
      val (code, captured) = Captured.run("compare", image, file)
      assert(code == 0)
      assert(captured.out.contains("\nreference     MSE "))
      assert(captured.out.contains("\nwithout it    MSE "))
      val itself = Captured.run("compare", file, file)._2.out
      assert(itself.contains("without it    MSE not resolved (-"))
      // And it is what several renderings show
      val seeds = folder.resolve("seeds")
      Files.createDirectory(seeds)
      for i <- 1 to 6 do
        val out = seeds.resolve(s"$i.exr").toString
        assert(Captured.run(ball, "--seed", s"$i", "--spp", "4", "--outfile", out)._1 == 0)
      assert(Captured.run("compare", "--bias", seeds.toString, file)._1 == 0)

  test("a goal is needed, a file that holds the error, and a place that can be written"):
    TempFolder.use: folder =>
      val ball = scene(folder)
      assert(run(ball)._1 == 2)
      val bad = run(ball, "--error", "x%")
      assert(bad._1 == 2 && bad._2.err.contains("percentage"))
      val png = run(ball, "--error", "5%", "--outfile", folder.resolve("r.png").toString)
      assert(png._1 == 1 && png._2.err.contains("only .exr files hold"))
      val nowhere = folder.resolve("no/where.exr").toString
      assert(run(ball, "--error", "5%", "--outfile", nowhere)._1 == 1)
      assert(run(ball, "--error", "5%", "--outfile", ball)._1 == 1)

  test("a goal that can't be read is the only error"):
    TempFolder.use: folder =>
      val ball = scene(folder)
      for goal <- Vector("0", "-1%", "nan", "5%%") do
        val (code, captured) = run(ball, "--error", goal)
        assert(code == 2 && captured.err.contains(s"found `$goal`"))
        assert(!captured.err.contains("reference needs"))

  test("a place without files can't be written, and is not said to be read"):
    assume(Files.isDirectory(Path.of("/proc")))
    TempFolder.use: folder =>
      val (code, captured) = run(scene(folder), "--error", "5%", "--outfile", "/proc/x.exr")
      assert(code == 1)
      assert(captured.err.startsWith("error: can't write `/proc/x."), captured.err)
      assert(captured.err.contains("[E0105]"))
