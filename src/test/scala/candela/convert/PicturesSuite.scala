package candela.convert

import java.nio.file.Path

import candela.image.{Image, ImageFiles, Samples}
import candela.scenefile.*
import candela.testing.SceneTexts

import org.scalatest.funsuite.AnyFunSuite

/** Converted scenes look as before, in the program of their new dialect. */
class PicturesSuite extends AnyFunSuite:

  private def view(dialect: Dialect) =
    val isV4 = dialect == Dialect.V4
    val film = if isV4 then "rgb" else "image"
    "LookAt 3 1 -40 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 6 \"float shutteropen\" 0 " +
      s"\"float shutterclose\" 1 Film \"$film\" \"integer xresolution\" 16 " +
      "\"integer yresolution\" 16 PixelFilter \"box\" Sampler \"halton\" " +
      "\"integer pixelsamples\" 64 Integrator \"path\" \"integer maxdepth\" 1 WorldBegin\n"

  private def end(dialect: Dialect) = if dialect == Dialect.V4 then "" else "\nWorldEnd"

  private val turning =
    "LightSource \"distant\" \"point from\" [0 0 -1] \"point to\" [0 0 0] \"rgb L\" [3 3 3]\n" +
      "ObjectBegin \"o\" Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] " +
      "\"point P\" [-1 -.1 0 1 -.1 0 1 .1 0 -1 .1 0] ObjectEnd\n" +
      "AttributeBegin ActiveTransform StartTime Rotate -60 0 1 0 ActiveTransform EndTime " +
      "Rotate 60 0 1 0 ActiveTransform All ObjectInstance \"o\" AttributeEnd"

  private def converted(text: String, from: Dialect, to: Dialect, folder: Path = Path.of("")) =
    Converter.convert(SceneTexts.parse(text, from, folder), to, folder)

  test("instances that turn keep their path: pbrt-v4's is around the camera, v3's is not"):
    // Of pbrt-v3, and of pbrt-v4 without and with the world as rendering space
    for
      (from, to, option, mean) <- Seq(
        (Dialect.V3, Dialect.V4, "", 0.0076f),
        (Dialect.V4, Dialect.V3, "", 0.0035f),
        (Dialect.V4, Dialect.V3, "Option \"rendercoordsys\" \"camera\" ", 0.0035f),
        (Dialect.V4, Dialect.V3, "Option \"rendercoordsys\" \"world\" ", 0.0076f)
      )
    do
      val text = option + view(from) + turning + end(from)
      val made = converted(text, from, to)
      // 16,384 samples of a thin quad
      for (t, d) <- Seq(text -> from, Descriptions.text(made.scene) -> to) do
        val found = SceneTexts.mean(t, d).g
        assert(Math.abs(found - mean) < 0.05f * mean, s"$from, $option as $d: $found")

  test("a shutter of v2 and v3 that v4 refuses keeps its image"):
    for
      from <- Seq(Dialect.V2, Dialect.V3)
      (open, close) <- Seq(0f -> 0f, 0.5f -> 0.5f, 1f -> 0f, 7e6f -> 7e6f, 0.25f -> 0.75f)
    do
      val shutter = s"shutteropen\" $open \"float shutterclose\" $close"
      val text = "LookAt 3 1 -4 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 30 " +
        s"\"float $shutter Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 " +
        "WorldBegin LightSource \"infinite\" Shape \"sphere\" WorldEnd"
      val made = converted(text, from, Dialect.V4).scene
      val written = Descriptions.read(Descriptions.text(made), Path.of(""), Some(Dialect.V4))
      val (before, after) = (SceneTexts.mean(text, from), SceneTexts.mean(written))
      assert((before - after).largest < 0.02f * before.max, s"$from, $shutter: $before, $after")

  test("v2's integrators of direct light stay direct in v3 and v4"):
    val corner =
      "Translate 0 0 4 LightSource \"point\" \"point from\" [1 1 -3] \"color I\" [9 9 9]\n" +
        "Material \"matte\" \"color Kd\" [.8 .8 .8] Shape \"disk\" \"float radius\" 9 " +
        "Rotate 70 0 1 0 Translate 0 0 3 Shape \"disk\" \"float radius\" 9"
    for
      integrator <- Seq("diffuseprt", "dipolesubsurface", "glossyprt\" \"color Kd\" [.2 .4 .6")
      to <- Seq(Dialect.V3, Dialect.V4)
      // v4's plastic is another
      if to == Dialect.V3 || !integrator.startsWith("glossyprt")
    do
      val name = if integrator.contains('[') then s"$integrator]" else s"$integrator\""
      val text = "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16 " +
        s"SurfaceIntegrator \"$name WorldBegin\n$corner WorldEnd"
      val made = converted(text, Dialect.V2, to)
      val (before, after) = (SceneTexts.mean(text, Dialect.V2), SceneTexts.mean(made.scene))
      assert((before - after).largest < 0.01f * before.max, s"$name, $to: $before, $after")
      assert(made.warnings.forall(!_.message.contains("the same image")), made.warnings)

  test("colours that pbrt-v4 refuses are clamped, with a warning at their place"):
    val bright = "Material \"diffuse\" \"rgb reflectance\" [1.5 .5 -2] Shape \"sphere\" " +
      "LightSource \"infinite\" \"rgb L\" [3 -1 2]"
    val made = converted(view(Dialect.V4) + bright, Dialect.V4, Dialect.V4)
    assert(Descriptions.text(made.scene).contains("[ 1 0.5 0 ]"))
    assert(made.scene.lights.head.light.param("L").get.floats.toSeq == Seq(3f, 0f, 2f))
    assert(made.warnings.count(_.message.contains("pbrt-v4 takes only")) == 2)

  test("a small slide is enlarged, for pbrt-v3 interpolates between its pixels, and v4 does not"):
    Samples.inFolder: folder =>
      val data = Array.tabulate(18)(i => (i * 7 % 5) / 4f)
      ImageFiles.write(folder.resolve("slide.exr"), Image(3, 2, Image.RgbNames, data))
      for
        (from, name, to, other) <- Seq(
          (Dialect.V3, "mapname", Dialect.V4, "filename"),
          (Dialect.V4, "filename", Dialect.V3, "mapname")
        )
      do
        val light = s"LightSource \"projection\" \"string $name\" \"slide.exr\""
        val made = converted(view(from) + light + end(from), from, to, folder)
        val slide = made.scene.lights.head.light.param(other).get.strings.head
        val image = ImageFiles.read(folder.resolve(slide)).linear.toRgb
        assert(image.width * 2 == image.height * 3 && image.width > 500)
        def red(x: Float) =
          image.data(3 * (image.width * (image.height / 4) + (x * image.width).toInt))
        // Between the centres of two pixels, and at the third of a pixel
        val (left, right) = (data(0), data(3))
        val between = left + (right - left) * 0.25f
        val expected = if from == Dialect.V3 then between else left
        // Half a pixel of 1000, and half floats
        assert(Math.abs(red(0.25f) - expected) < 5e-3f, s"$from: ${red(0.25f)}, $expected")

  test("a small environment map is enlarged, for pbrt-v4 does not interpolate between its pixels"):
    Samples.inFolder: folder =>
      // Brightest at the horizon
      val data = Array.tabulate(16 * 8 * 3): i =>
        val row = i / (16 * 3)
        Math.min(row, 7 - row).toFloat
      ImageFiles.write(folder.resolve("sky-latlong.exr"), Image(16, 8, Image.RgbNames, data))
      val light = "LightSource \"infinite\" \"string mapname\" \"sky-latlong.exr\"\nWorldEnd"
      val made = converted(view(Dialect.V3) + light, Dialect.V3, Dialect.V4, folder)
      val file = made.scene.lights.head.light.param("filename").get.strings.head
      val image = ImageFiles.read(folder.resolve(file)).linear.toRgb
      val steps =
        for y <- 0 until image.height; x <- 1 until image.width
        yield Math.abs(image(x, y, 0) - image(x - 1, y, 0))
      // A row of the map is 0.4 radians high, a pixel here some 0.004
      assert(steps.max < 0.05f && steps.max > 0f, steps.max)
      assert(made.warnings.isEmpty, made.warnings)

  test("slides and skies of 8 bits are not decoded in v3, and are as bright in v4"):
    Samples.inFolder: folder =>
      val grey = Image(8, 4, Image.RgbNames, Array.fill(96)(0.25f))
      ImageFiles.write(folder.resolve("grey.png"), grey)
      for kind <- Seq("projection", "infinite", "goniometric") do
        val light = s"LightSource \"$kind\" \"string mapname\" \"grey.png\"\nWorldEnd"
        val made = converted(view(Dialect.V3) + light, Dialect.V3, Dialect.V4, folder)
        val file = made.scene.lights.head.light.param("filename").get.strings.head
        val image = ImageFiles.read(folder.resolve(file)).linear.toRgb
        // 8 bits, then half floats
        assert(image.data.forall(x => Math.abs(x - 0.537f) < 3e-3f), s"$kind: ${image.data(0)}")

  private def meansAreKept(folder: Path, from: Dialect, to: Dialect, world: String) =
    val scene = SceneTexts.parse(view(from) + world + end(from), from, folder)
    val made = Converter.convert(scene, to, folder)
    val (before, after) = (SceneTexts.mean(scene), SceneTexts.mean(made.scene))
    // Half floats, and images seen through others
    for (x, y) <- Seq(before.r -> after.r, before.g -> after.g, before.b -> after.b) do
      assert(Math.abs(x - y) < 0.01f * before.max && x > 1e-3f, s"$before, $after")
    assert(made.warnings.isEmpty, made.warnings)

  private def coloured(folder: Path, name: String, width: Int, height: Int) =
    val data = Array.tabulate(3 * width * height)(i => Array(.2f, .9f, .4f)(i % 3))
    ImageFiles.write(folder.resolve(name), Image(width, height, Image.RgbNames, data))

  test("a goniometric light keeps the colours of its image, which v4 averages"):
    Samples.inFolder: folder =>
      coloured(folder, "light.exr", 64, 32)
      coloured(folder, "square.exr", 64, 64)
      val light = "Translate 5 3 -9 LightSource \"goniometric\" \"rgb I\" [150 300 200]"
      val ball = "\nIdentity Material \"%s\" Shape \"sphere\""
      val inV3 = s"$light \"string mapname\" \"light.exr\"${ball.format("matte")}"
      meansAreKept(folder, Dialect.V3, Dialect.V4, inV3)
      val inV4 = s"$light \"string filename\" \"square.exr\"${ball.format("diffuse")}"
      meansAreKept(folder, Dialect.V4, Dialect.V3, inV4)

  test("a float texture of a coloured image keeps its numbers: luminances in v3, means in v4"):
    Samples.inFolder: folder =>
      for (name, options) <- Seq("a.exr" -> "", "b.png" -> "", "c.png" -> "linear") do
        coloured(folder, name, 4, 4)
        def scene(kind: String, material: String, decoding: String) =
          s"LightSource \"infinite\" Texture \"t\" \"float\" \"imagemap\" \"string filename\" " +
            s"\"$name\" $decoding Texture \"s\" \"$kind\" \"mix\" \"texture amount\" \"t\" " +
            s"\"rgb tex1\" [.1 .1 .1] \"rgb tex2\" [.8 .8 .8] $material \"s\" Shape \"sphere\""
        val (gamma, encoding) =
          if options.isEmpty then ("", "")
          else ("\"bool gamma\" \"false\"", "\"string encoding\" \"linear\"")
        val v3 = scene("spectrum", "Material \"matte\" \"texture Kd\"", gamma)
        meansAreKept(folder, Dialect.V3, Dialect.V4, v3)
        val v4 = scene("spectrum", "Material \"diffuse\" \"texture reflectance\"", encoding)
        meansAreKept(folder, Dialect.V4, Dialect.V3, v4)

  /** The sphere fills the view: each pixel shows one reflection. */
  private def sphere(dialect: Dialect, color: String, light: String, depth: Int = 1) =
    val matte =
      if dialect == Dialect.V4 then "\"diffuse\" \"rgb reflectance\"" else "\"matte\" \"rgb Kd\""
    view(dialect).replace("maxdepth\" 1", s"maxdepth\" $depth") + "LightSource \"infinite\" " +
      s"$light\nMaterial $matte [$color] Shape \"sphere\" \"float radius\" 20${end(dialect)}"

  private def shifts(text: String, from: Dialect) =
    val to = if from == Dialect.V3 then Dialect.V4 else Dialect.V3
    val made = converted(text, from, to)
    (made.scene, made.warnings.filter(_.message.contains("multiplies spectra")))

  test("colours that pbrt-v4 shows otherwise, since it multiplies spectra, are named"):
    def said(kd: String, l: String) = shifts(sphere(Dialect.V3, kd, l), Dialect.V3)._2
    // pbrt-v3: .7245 .0548 .0158; pbrt-v4: .6661 .0422 .0072
    val deep = said(".8 .2 .1", "\"xyz L\" [.5 .4 .2]")
    assert(deep.length == 1 && deep.head.pos.exists(_.line == 3), deep)
    assert(deep.head.message.contains("pbrt-v3 red, green and blue"))
    assert(said(".5 .5 .5", "\"xyz L\" [.5 .4 .2]").isEmpty)
    assert(said(".6 .5 .4", "\"rgb L\" [1 .9 .8]").isEmpty)

  test("the difference that is named is that of the images, in both directions"):
    for
      from <- Seq(Dialect.V3, Dialect.V4)
      light <- Seq("rgb L\" [1 1 1]", "rgb L\" [1 .1 .1]", "rgb L\" [.1 .2 .9]",
        "rgb L\" [.2 1 .1]", "blackbody L\" 2500")
    do
      val text = sphere(from, ".9 .2 .1", "\"" + light)
      val (made, warnings) = shifts(text, from)
      val (before, after) = (SceneTexts.mean(text, from), SceneTexts.mean(made))
      val inV4 = if from == Dialect.V4 then before else after
      val percent = 100 * (before - after).largest / inV4.max
      if light.contains("1 1 1") then assert(warnings.isEmpty && percent < 0.5f, s"$percent")
      else
        val stated = "(\\d+) % of its brightest channel in pbrt-v4".r
          .findFirstMatchIn(warnings.head.message).get.group(1).toInt
        assert(Math.abs(stated - percent) < 1f, s"$from, $light: $stated, $percent")
        assert(warnings.length == 1 && warnings.head.pos.exists(_.line == 3))
        assert(warnings.head.help.exists(_.contains(":2:")), warnings.head.help)

  test("colours that differ after two reflections only are named as such"):
    def said(depth: Int, more: String) =
      val text = sphere(Dialect.V4, ".9 .2 .1", s"\"rgb L\" [2 2 2] $more", depth)
      shifts(text, Dialect.V4)._2.map(p => (p.message, p.help))
    assert(said(1, "").isEmpty)
    val twice = said(2, "")
    assert(twice.exists((m, help) => m.contains("light reflected twice here") && help.isEmpty))
    // In white light alone, a wall of green has the greater difference from red
    val both = said(2, "\nMaterial \"diffuse\" \"rgb reflectance\" [.1 .8 .1] Shape \"disk\"")
    assert(
      both.exists((m, help) =>
        m.contains("reflected here and elsewhere") && help.exists(_.startsWith("elsewhere: "))
      ),
      both
    )

  test("spectra of pbrt-v4's surfaces are compared with their colours"):
    val light = "\"blackbody L\" 6500"
    val lines = sphere(Dialect.V4, ".9 .2 .1", light)
      .replace("rgb reflectance\" [.9 .2 .1]", "spectrum reflectance\" [400 0 580 0 581 1 700 1]")
      .replace(light, "\"rgb L\" [.2 1 .1]")
    assert(shifts(lines, Dialect.V4)._2.length == 1)

  test("float textures have no colours"):
    Samples.inFolder: folder =>
      coloured(folder, "numbers.png", 4, 4)
      def count(kind: String) =
        val text = view(Dialect.V4) + "LightSource \"infinite\" \"rgb L\" [1 .2 .1]\n" +
          s"Texture \"t\" \"$kind\" \"imagemap\" \"string filename\" \"numbers.png\""
        val made = converted(text, Dialect.V4, Dialect.V3, folder)
        made.warnings.count(_.message.contains("the mean of light reflected here"))
      assert(count("float") == 0 && count("spectrum") == 1)
