package candela.build.lights

import candela.build.recipe.{Findings, Resources, Site}
import candela.cli.Captured
import candela.color.ColorBasis
import candela.diagnostics.Code
import candela.image.{Image, ImageFiles}
import candela.lights.PictureLookup
import candela.scenefile.Dialect
import candela.testing.{SceneTexts, TempFolder}

import org.scalatest.funsuite.AnyFunSuite

final class LightImagesSuite extends AnyFunSuite:
  test("lights with one image share it, those of another basis or lookup do not"):
    TempFolder.use: folder =>
      val file = folder.resolve("shades.pfm")
      ImageFiles.write(file, Image(2, 2, Image.RgbNames, Array.tabulate(12)(_ / 12f)))
      val light = s"LightSource \"projection\" \"string filename\" \"$file\"\n"
      val statements = SceneTexts.parse(s"WorldBegin\n$light$light", Dialect.V4).lights.map(_.light)
      val resources = Resources(ColorBasis.Srgb)
      def picture(k: Int, lookup: PictureLookup, resources: Resources) =
        val site = Site(statements(k), Dialect.V4, resources, Findings())
        LightImages.picture("filename", lookup)(using site).get
      val first = picture(0, PictureLookup.Nearest, resources)
      assert(picture(1, PictureLookup.Nearest, resources) eq first)
      assert(picture(1, PictureLookup.Smooth, resources) ne first)
      val sharp = resources.in(ColorBasis.Sharp)
      assert(picture(1, PictureLookup.Nearest, sharp) ne first)
      assert(first.meanOfMax > 0.3f)

  test("an equirectangular map of v4 stays as it is in v3"):
    TempFolder.use: folder =>
      val data = Array.tabulate(3 * 64 * 32)(i => 0.2f + (if i / 192 < 12 then 1f else 0f))
      ImageFiles.write(folder.resolve("wide.exr"), Image(64, 32, Image.RgbNames, data))
      val text =
        """Film "rgb" "integer xresolution" 8 "integer yresolution" 8
          |LookAt 0 -5 1  0 0 0  0 0 1
          |Camera "perspective" "float fov" 30
          |WorldBegin
          |LightSource "infinite" "string filename" "wide.exr"
          |Material "diffuse" "rgb reflectance" [.8 .8 .8]
          |Shape "sphere"
          |""".stripMargin
      val four = java.nio.file.Files.writeString(folder.resolve("four.pbrt"), text)
      val three = folder.resolve("three.pbrt")
      assert(Captured.run("convert", s"$four", "--to", "v3", "--outfile", s"$three")._1 == 0)
      val means = Vector(four, three).map: scene =>
        val out = folder.resolve("a.exr")
        assert(Captured.run(s"$scene", "--spp", "64", "--outfile", s"$out")._1 == 0)
        ImageFiles.read(out).data.sum
      assert(Math.abs(means(0) / means(1) - 1) < 0.02f, means)

  test("an equirectangular map in v4 is read as its conversion, with a warning"):
    TempFolder.use: folder =>
      val wide = folder.resolve("wide.exr")
      val data = Array.tabulate(3 * 64 * 32): i =>
        val (c, x, y) = (i % 3, i / 3 % 64, i / 192)
        0.2f + (c + 1) * x / 64f + (if y < 12 then 1f else 0f)
      ImageFiles.write(wide, Image(64, 32, Image.RgbNames, data))
      val even = folder.resolve("even.exr")
      val words = Vector("image", s"$wide", "--outfile", s"$even", "--environment", "equalarea")
      assert(Captured.run(words*)._1 == 0)
      def scene(file: java.nio.file.Path, more: String) =
        s"""Film "rgb" "integer xresolution" 8 "integer yresolution" 8
           |LookAt 0 -5 1  0 0 0  0 0 1
           |Camera "perspective" "float fov" 30
           |Sampler "independent" "integer pixelsamples" 256
           |WorldBegin
           |LightSource "infinite" "string filename" "$file" $more
           |Material "diffuse" "rgb reflectance" [.8 .8 .8]
           |Shape "sphere"
           |""".stripMargin
      for more <- Vector("", "\"float illuminance\" 3") do
        val direct = SceneTexts.mean(scene(wide, more), Dialect.V4)
        val converted = SceneTexts.mean(scene(even, more), Dialect.V4)
        for (a, b) <- Vector(direct.r -> converted.r, direct.b -> converted.b) do
          // EXR files of equal-area maps have red and blue exchanged there, as in pbrt-v4
          val tolerance = if more.isEmpty then 0.02f else 0.5f
          assert(Math.abs(a / b - 1) < tolerance, (more, direct, converted))
      val told = SceneTexts.problems(scene(wide, ""), Dialect.V4)
      assert(told.map(_.code) == Vector(Code.UnlikePbrt), told)
      assert(SceneTexts.problems(scene(even, ""), Dialect.V4).isEmpty)
