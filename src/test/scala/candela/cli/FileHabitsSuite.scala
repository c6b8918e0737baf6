package candela.cli

import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

import candela.image.{Image, ImageFiles, PixelFormat}
import candela.testing.{Gzip, TempFolder}

/** Files as they come: names in any language, compressed, with Windows line ends, in folders. */
class FileHabitsSuite extends AnyFunSuite:

  private val mesh =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n" +
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
      "-9 -9 4\n9 -9 4\n0 9 4\n3 0 1 2\n"

  /** A scene with a texture, meshes and includes in folders beside it. */
  private def write(folder: Path): Path =
    assume(System.getProperty("sun.jnu.encoding") == "UTF-8", "names of files are ASCII here")
    def put(name: String, bytes: Array[Byte]) =
      val file = folder.resolve(name)
      val _ = Files.createDirectories(file.getParent)
      Files.write(file, bytes)
    def lines(texts: String*) = texts.map(_ + "\r\n").mkString.getBytes(UTF_8)
    val _ = put("Körper/große Fläche.ply", mesh.replace("\n", "\r\n").getBytes)
    put("Körper/große Fläche.ply.gz", Gzip.of(mesh.getBytes))
    put(
      "素材/stoff.pbrt",
      lines(
        "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"素材/bild ñ.png\"",
        "Material \"diffuse\" \"texture reflectance\" \"t\""
      )
    )
    put(
      "Körper/alle.pbrt.gz",
      Gzip.of(lines(
        "# Windows",
        "Include \"素材/stoff.pbrt\"",
        "Shape \"plymesh\" \"string filename\" \"Körper/große Fläche.ply.gz\"",
        "Shape \"plymesh\" \"string filename\" \"Körper/große Fläche.ply\""
      ))
    )
    ImageFiles.write(folder.resolve("素材/bild ñ.png"), Image.rgb(2, 2))
    put(
      "die Szene.pbrt",
      lines(
        "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4",
        "Sampler \"independent\" \"integer pixelsamples\" 1",
        "WorldBegin",
        "LightSource \"infinite\"",
        "Include \"Körper/alle.pbrt.gz\""
      )
    )

  private def run(words: String*): Captured =
    val captured = Captured()
    val code = Main.run(words, captured.terminal)
    assert(code == 0, captured.err)
    captured

  test("names with spaces and of any language, Windows line ends, includes of other folders"):
    TempFolder.use: folder =>
      val scene = write(folder.resolve("ein Ordner é"))
      val checked = run("check", scene.toString)
      assert(checked.err.isEmpty && checked.out.contains("2 shapes, 1 light, 1 texture"))

  test("a compressed scene is rendered, and converted with its files"):
    TempFolder.use: folder =>
      val scene = write(folder.resolve("ein Ordner é"))
      val packed = scene.resolveSibling("die Szene.pbrt.gz")
      val _ = Files.write(packed, Gzip.of(Files.readAllBytes(scene)))
      val image = folder.resolve("Bild ü.exr")
      val rendered = run(packed.toString, "--outfile", image.toString)
      assert(rendered.err.isEmpty)
      // The mesh covers the middle, with the black texture
      assert(ImageFiles.read(image)(2, 2, 0) == 0f)
      val other = folder.resolve("v3 ß.pbrt")
      val _ = run("convert", packed.toString, "--to", "v3", "--outfile", other.toString)
      assert(run("check", other.toString).out.contains("2 shapes, 1 light, 1 texture"))

  test("an AttributeBegin that is never ended is reported with its place"):
    TempFolder.use: folder =>
      val scene = folder.resolve("a.pbrt")
      val _ = Files.writeString(scene, "WorldBegin\r\nAttributeBegin\r\nShape \"sphere\"\r\n")
      val captured = Captured()
      assert(Main.run(Seq("check", scene.toString), captured.terminal) == 1)
      assert(captured.err.contains("a.pbrt:2:1: error: AttributeBegin is never closed"))

  test("an image has the same bytes wherever its scene is"):
    TempFolder.use: folder =>
      val text = "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 3\n" +
        "Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\n"
      val images =
        for place <- Vector("here", "there/below") yield
          val within = Files.createDirectories(folder.resolve(place))
          val scene = Files.writeString(within.resolve("a.pbrt"), text)
          val image = within.resolve("a.exr")
          assert(Captured.run(s"$scene", "-o", s"$image", "--spp", "1", "--quiet")._1 == 0)
          assert(ImageFiles.facts(image).contains("scene" -> "a.pbrt"))
          Files.readAllBytes(image)
      assert(images(0).sameElements(images(1)))

  test("variances beyond the range of halves are whole in images of halves"):
    TempFolder.use: folder =>
      val emitter = "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\n" +
        "LookAt 0 0 -2  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 90\nWorldBegin\n" +
        "Shape \"disk\" \"float radius\" 9\nTranslate 0 0 -3\n" +
        "AreaLightSource \"diffuse\" \"rgb L\" [60000 60000 60000]\n" +
        "Shape \"sphere\" \"float radius\" .9\n"
      val scene = Files.writeString(folder.resolve("a.pbrt"), emitter)
      val image = folder.resolve("a.exr")
      val words = Seq("--aov", "variance", "--spp", "16", "--quiet", "-o", s"$image", s"$scene")
      assert(Captured.run(words*)._1 == 0)
      val written = ImageFiles.read(image)
      val at = written.channelNames.indexOf("Variance.R")
      assert((0 until 16).exists(i => written.data(i * written.channels + at) > 65504f))

  test("images of Mitsuba's films have the channels of `pixel_format`, pictures their colours"):
    TempFolder.use: folder =>
      def channels(format: String, name: String): Vector[String] =
        val scene = Files.writeString(
          folder.resolve("scene.xml"),
          s"""<scene version="3.0.0"><integrator type="path"/><sensor type="perspective">
            <film type="hdrfilm"><string name="pixel_format" value="$format"/>
            <integer name="width" value="2"/><integer name="height" value="2"/></film></sensor>
            <emitter type="constant"><rgb name="radiance" value=".2 .5 .9"/></emitter></scene>"""
        )
        val image = folder.resolve(name)
        val rendered = run(scene.toString, "--outfile", image.toString)
        assert(!rendered.err.contains("pixel_format"), rendered.err)
        ImageFiles.read(image).channelNames
      assert(channels("luminance", "a.exr") == Vector("Y"))
      assert(channels("xyza", "b.exr").toSet == Set("X", "Y", "Z", "A"))
      assert(channels("rgb", "c.exr") == Image.RgbNames)
      assert(channels("luminance", "d.png") == Image.RgbNames)
      val shown = folder.resolve("b.png")
      val _ = run("image", folder.resolve("b.exr").toString, "--outfile", shown.toString)
      val Vector(r, g, b) = ImageFiles.read(shown).toRgb.data.take(3).toVector: @unchecked
      assert(Math.abs(r - 0.2) < 0.01 && Math.abs(g - 0.5) < 0.01 && Math.abs(b - 0.9) < 0.01)

  test("depth beside X, Y and Z has a name of its own"):
    val data = Array(0.2f, 0.5f, 0.9f, 7f)
    val image = Image(1, 1, Image.RgbNames :+ "Z", data)
    assert(PixelFormat.Tristimulus(image).channelNames == Vector("X", "Y", "Z", "Depth.Z"))
