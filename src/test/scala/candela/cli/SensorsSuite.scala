package candela.cli

import candela.image.ImageFiles
import candela.mitsuba.MitsubaScene
import candela.testing.TempFolder

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

/** Several sensors of a Mitsuba scene. */
final class SensorsSuite extends AnyFunSuite:
  private def sensor(width: Int) = s"""<sensor type="perspective"><film type="hdrfilm">
    <integer name="width" value="$width"/><integer name="height" value="4"/></film>
    <sampler type="independent"><integer name="sample_count" value="1"/></sampler></sensor>"""

  private def scene(folder: Path, widths: Int*): Path =
    val text = s"""<scene version="3.0.0"><integrator type="path"/><emitter type="constant"/>
      ${widths.map(sensor).mkString}<shape type="sphere"/></scene>"""
    Files.writeString(folder.resolve("s.xml"), text)

  private def width(file: Path): Int = ImageFiles.read(file).width

  test("all sensors are rendered in one run, each to an image"):
    TempFolder.use: folder =>
      val file = scene(folder, 4, 6, 8)
      val images = folder.resolve("v%d.exr")
      val (code, captured) = Captured.run(s"$file", "--sensor", "all", "--outfile", s"$images")
      assert(code == 0, captured.err)
      for (width, i) <- Seq(4, 6, 8).zipWithIndex do
        assert(this.width(folder.resolve(s"v$i.exr")) == width)
      assert(!captured.err.contains("only the first sensor"))

  test("one sensor is rendered by its number, without a number in the image's name"):
    TempFolder.use: folder =>
      val image = folder.resolve("v.exr")
      val file = scene(folder, 4, 6)
      val (code, captured) = Captured.run(s"$file", "--sensor", "1", "--outfile", s"$image")
      assert(code == 0 && width(image) == 6, captured.err)

  test("`%d` is the number of the image, also where there is only one"):
    TempFolder.use: folder =>
      def written(options: String*)(name: String, widths: Int*)(image: String) =
        val words = Vector(s"${scene(folder, widths*)}", "-o", s"$folder/$name") ++ options
        val (code, captured) = Captured.run(words*)
        assert(code == 0 && Files.deleteIfExists(folder.resolve(image)), captured.err)
      written("--sensor", "all")("v-%d.exr", 4)("v-0.exr")
      written("--sensor", "0")("v-%02d.exr", 4)("v-00.exr")
      written("--sensor", "1")("v%d.exr", 4, 6)("v1.exr")
      written("--sensor", "1", "--spark", "fake")("v%d.exr", 4, 6)("v1.exr")
      written()("v%d.exr", 4)("v%d.exr")
      val several = Vector(s"${scene(folder, 4, 6)}", "--sensor", "all", "--spark", "fake")
      val (code, captured) = Captured.run((several ++ Vector("-o", s"$folder/v%d.exr"))*)
      assert(code == 1 && captured.err.contains("has several images; --spark renders one"))

  test("commands for one image say that all sensors are not meant"):
    TempFolder.use: folder =>
      val file = scene(folder, 4, 6)
      def said(words: String*) =
        val (code, captured) = Captured.run(words*)
        assert(code == 0, captured.err)
        captured.err.contains("the file has several sensors; this is about the first")
      for command <- Vector("check", "convert") do
        assert(said(command, s"$file", "--sensor", "all"))
        assert(!said(command, s"$file", "--sensor", "1"))

  test("images without a name have that of the scene and the sensor's number"):
    TempFolder.use: folder =>
      def name(sensor: Option[Int], widths: Int*) =
        val file = scene(folder, widths*)
        val read = MitsubaScene.readable(file, Map.empty, keepGoing = false, sensor = sensor)
        read.film.get.param("filename").get.strings.head
      assert(name(None, 4, 6) == "s.exr")
      assert(name(Some(0), 4, 6) == "s-0.exr" && name(Some(1), 4, 6) == "s-1.exr")
      assert(name(Some(0), 4) == "s.exr")

  test("a scene without a sensor is an error, as for Mitsuba's own program"):
    TempFolder.use: folder =>
      val (code, captured) = Captured.run(s"${scene(folder)}", "--outfile", s"$folder/v.exr")
      assert(code == 1 && captured.err.contains("the scene has no sensor"), captured.err)

  test("sensors that are not there, and several for one image, are errors"):
    TempFolder.use: folder =>
      val file = scene(folder, 4, 6)
      val image = folder.resolve("v.exr")
      def said(words: String*) =
        val (code, captured) = Captured.run(words*)
        assert(code == 1)
        captured.err
      val missing = said(s"$file", "--sensor", "2", "--outfile", s"$image")
      assert(missing.contains("there is no sensor 2") && missing.contains("0 to 1"), missing)
      val one = said(s"$file", "--sensor", "all", "--outfile", s"$image")
      assert(one.contains("has several sensors, each an image;"), one)
      val pbrt = Files.writeString(folder.resolve("s.pbrt"), "WorldBegin\nShape \"sphere\"\n")
      val alien = said(s"$pbrt", "--sensor", "1", "--outfile", s"$image")
      assert(alien.contains("has no sensors"), alien)
