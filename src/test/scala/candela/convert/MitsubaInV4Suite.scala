package candela.convert

import candela.bsdf.Fresnel
import candela.color.{Encoding, Rgb, Srgb}
import candela.image.{Image, ImageFiles, Samples}
import candela.math.sqrt
import candela.mitsuba.MitsubaScene
import candela.scenefile.{Declaration, Dialect, MaterialRef}
import candela.testing.SceneTexts

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

class MitsubaInV4Suite extends AnyFunSuite:

  private def converted(folder: Path, body: String): Converted =
    val file = folder.resolve("scene.xml")
    val _ =
      Files.writeString(
        file,
        s"<scene version=\"3.0.0\"><sensor type=\"perspective\"/>$body</scene>"
      )
    val scene = MitsubaScene.readable(file, Map.empty, keepGoing = false)
    Converter.convert(scene, Dialect.V4, folder)

  private def converted(body: String): Converted = Samples.inFolder(converted(_, body))

  private def material(c: Converted, shape: Int = 0): Declaration =
    c.scene.shapes(shape).material match
      case MaterialRef.Inline(d) => d
      case other => fail(other.toString)

  private def sphere(bsdf: String) = s"<shape type=\"sphere\">$bsdf</shape>"

  private val emitter = sphere("<bsdf type=\"null\"/><emitter type=\"area\"/>")

  test("area lights that light passes become glass of index 1, since pbrt-v4 ignores their light"):
    val done = converted(emitter + sphere("<bsdf type=\"null\"/>"))
    assert(material(done).name == "dielectric")
    assert(material(done).param("eta").get.floats.toVector == Vector(1f))
    assert(material(done, 1).name == "interface" && done.warnings.isEmpty)
    val shaded = converted(s"\n$emitter\n<emitter type=\"point\"/>").warnings
    assert(shaded.map(_.message) ==
      Vector("pbrt-v4 has no transparent area lights; this one casts shadows"))
    assert(shaded.head.pos.map(_.line).contains(2) && shaded.head.help.get.contains(":3:1"))

  private val small = "<sensor type=\"perspective\"><film type=\"hdrfilm\">" +
    "<integer name=\"width\" value=\"12\"/><integer name=\"height\" value=\"12\"/></film>" +
    "<sampler type=\"independent\"><integer name=\"sample_count\" value=\"64\"/></sampler>" +
    "</sensor>"

  /** A turned lamp before a wall. */
  private def lamp(shape: String, flips: Boolean, x: Int) =
    s"<shape type=\"$shape\"><boolean name=\"flip_normals\" value=\"$flips\"/>" +
      s"<transform name=\"to_world\"><scale x=\"$x\"/><rotate y=\"1\" angle=\"40\"/>" +
      "<translate x=\".4\" z=\"5\"/></transform><emitter type=\"area\"/></shape>" +
      "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"9\"/>" +
      "<rotate y=\"1\" angle=\"180\"/><translate z=\"8\"/></transform></shape>"

  test("mirrored spheres and disks that emit become such as are not mirrored, as bright"):
    for shape <- Seq("sphere", "disk"); flips <- Seq(true, false); x <- Seq(-1, 1) do
      Samples.inFolder: folder =>
        val body = s"<integrator type=\"path\"/>$small${lamp(shape, flips, x)}"
        val file = folder.resolve("lamp.xml")
        val _ = Files.writeString(file, s"<scene version=\"3.0.0\">$body</scene>")
        val scene = MitsubaScene.readable(file, Map.empty, keepGoing = false)
        val made = Converter.convert(scene, Dialect.V4, folder).scene
        assert(!made.shapes.filter(_.areaLight.nonEmpty)
          .exists(_.objectToWorld.start.swapsHandedness))
        val (before, after) = (SceneTexts.mean(scene).g, SceneTexts.mean(made).g)
        // 9,216 samples
        assert(
          Math.abs(before - after) < 0.03f * before + 1e-6f,
          s"$shape, $flips, $x: $before, $after"
        )

  test("numbers of a coloured image are its luminances, which pbrt-v4 would average"):
    for (name, raw) <- Seq("a.exr" -> false, "b.png" -> false, "c.png" -> true) do
      Samples.inFolder: folder =>
        val data = Array.tabulate(48)(i => Array(.2f, .9f, .4f)(i % 3))
        ImageFiles.write(folder.resolve(name), Image(4, 4, Image.RgbNames, data))
        val made = converted(
          folder,
          sphere("<bsdf type=\"mask\"><texture name=\"opacity\" type=\"bitmap\"><string " +
            s"name=\"filename\" value=\"$name\"/><boolean name=\"raw\" value=\"$raw\"/>" +
            "</texture><bsdf type=\"diffuse\"/></bsdf>")
        )
        val file = made.scene.textures.head.texture.param("filename").get.strings.head
        val image = ImageFiles.read(folder.resolve(file)).linear.toRgb
        val stored = Rgb(.2f, .9f, .4f)
        val expected = if raw then stored.map(Srgb.encode(_)).luminance else stored.luminance
        // 8 bits, then half floats
        assert(Math.abs(image.data(0) - expected) < 5e-3f, s"$name: ${image.data(0)}, $expected")
        assert(image.data(0) == image.data(1) && image.data(0) == image.data(2))

  private def colored(light: String, wall: String) =
    converted(s"<emitter type=\"constant\"><rgb name=\"radiance\" value=\"$light\"/></emitter>\n" +
      sphere("<bsdf type=\"twosided\"><bsdf type=\"diffuse\">" +
        s"<rgb name=\"reflectance\" value=\"$wall\"/></bsdf></bsdf>")).warnings

  test("colours that differ as products of spectra are reported at the surface"):
    assert(colored("1, 1, 1", "0.3, 0.3, 0.3").isEmpty)
    assert(colored("17, 12, 4", "0.5, 0.5, 0.5").isEmpty)
    val red = colored("17, 12, 4", "0.63, 0.065, 0.05")
    assert(red.length == 1 && red.head.message.contains("multiplies spectra"))
    assert(red.head.pos.map(_.line).contains(2))
    val percent = "(\\d+) %".r.findFirstMatchIn(red.head.message).get.group(1).toInt
    assert(percent >= 1 && percent <= 20, red.head.message)

  test("media whose coefficients become two spectra are reported"):
    def fog(albedo: String) =
      val medium = s"<medium name=\"interior\" type=\"homogeneous\"><rgb name=\"albedo\" " +
        s"value=\"$albedo\"/></medium>"
      converted(sphere(s"<bsdf type=\"null\"/>$medium")).warnings.map(_.message)
    assert(fog("0.5, 0.5, 0.5").isEmpty)
    // A sphere of it has 9.5 % less red in pbrt-v4's image than in Mitsuba's
    val red = fog("0.99, 0.5, 0.5")
    assert(red.exists(_.contains("multiplies spectra")), red)

  /** A picture of 8 bits, half as bright as they can be. */
  private def grey(file: Path): Unit =
    val data = Array.fill(3 * 16 * 16)(Encoding.Srgb.decode(0.5f))
    ImageFiles.write(file, Image(16, 16, Image.RgbNames, data))

  private def stored(name: String, relief: Boolean) =
    val texture =
      s"<texture type=\"bitmap\" name=\"${if relief then "normalmap" else "reflectance"}\">" +
        s"<boolean name=\"raw\" value=\"true\"/>" +
        s"<string name=\"filename\" value=\"$name\"/></texture>"
    if relief then s"<bsdf type=\"normalmap\">$texture<bsdf type=\"diffuse\"/></bsdf>"
    else s"<bsdf type=\"diffuse\">$texture</bsdf>"

  test("raw images other than PNG are rewritten, since pbrt-v4 decodes them as sRGB"):
    Samples.inFolder: folder =>
      grey(folder.resolve("a.jpg"))
      grey(folder.resolve("a.png"))
      for relief <- Seq(false, true) do
        def file(name: String): String =
          val done = converted(folder, sphere(stored(name, relief)))
          val d = if relief then material(done) else done.scene.textures.head.texture
          d.param(if relief then "normalmap" else "filename").get.strings.head
        assert(file("a.png") == "a.png")
        val written = file("a.jpg")
        assert(written.endsWith(".exr"))
        val image = ImageFiles.read(folder.resolve(written)).linear
        // A code of 8 bits is 1 / 255, and JPEG is off by up to two
        assert(image.data.forall(x => Math.abs(x - 0.5f) < 0.01f))

  test("a metal whose reflection is scaled keeps its albedo"):
    def metal(tint: String) =
      material(converted(sphere(
        s"<bsdf type=\"conductor\"><string name=\"material\" value=\"Au\"/>$tint</bsdf>"
      )))
    def component(d: Declaration, name: String, c: Int) = d.param(name).get.floats(c)
    val (eta, k) = (Vector(0.143036f, 0.375307f, 1.44205f), Vector(3.983f, 2.38556f, 1.60336f))
    val half =
      metal("<rgb name=\"specular_reflectance\" value=\"0.5, 0.5, 0.5\"/>")
    assert(half.param("scale").isEmpty && half.param("eta").isEmpty)
    // Uniform in cos², as diffuse light is
    def albedo(eta: Float, k: Float) =
      val cosines = (0 until 400).map(i => sqrt((i + 0.5f) / 400))
      cosines.map(Fresnel.conductor(_, eta, k)).sum / 400
    for c <- 0 until 3 do
      val own = albedo(eta(c), k(c))
      val r = component(half, "reflectance", c)
      // pbrt-v4's index for a reflectance
      val tinted = albedo(1f, 2 * sqrt(r / (1 - r)))
      assert(Math.abs(tinted - 0.5f * own) < 1e-3f, s"$c: $own, $tinted")

  test("a metal of three numbers has other ones, since pbrt-v4 makes spectra of them"):
    val bsdf = "<bsdf type=\"conductor\"><string name=\"material\" value=\"Au\"/></bsdf>"
    val k = material(converted(sphere(bsdf))).param("k").get.floats
    // Renders by pbrt-v4 and Mitsuba then differ by 0.2 %, else by 4 %
    for (a, b) <- k.zip(Vector(3.034f, 2.496f, 1.583f)) do assert(Math.abs(a - b) < 2e-3f, k.toSeq)

  test("a Beckmann distribution becomes a GGX of equal median slope"):
    val rough = material(converted(sphere(
      "<bsdf type=\"roughdielectric\"><float name=\"alpha\" value=\"0.3\"/></bsdf>"
    )))
    assert(Math.abs(rough.param("uroughness").get.floats.head - 0.3f * sqrt(0.693147f)) < 1e-5f)
