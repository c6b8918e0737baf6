package candela.cli

import candela.cli.terminal.ExitCode
import candela.image.{Image, ImageFiles}
import candela.media.SampledGrid
import candela.testing.{Gzip, NanoVdb, TempFolder, VdbGrid}

import java.nio.file.{Files, Path}

import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

/** A damaged file that a scene names is a message with the place in the scene, the file and the
  * cause in words.
  */
class DamagedFilesSuite extends AnyFunSuite:

  private val head = "Camera \"perspective\"\n" +
    "Film \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" 4\n" +
    "WorldBegin\nLightSource \"infinite\"\n"

  private def texture(name: String) =
    head + s"Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"$name\"\n" +
      "Material \"diffuse\" \"texture reflectance\" \"t\"\nTranslate 0 0 5 Shape \"sphere\"\n"

  private def light(name: String) =
    head + s"LightSource \"infinite\" \"string filename\" \"$name\"\n"
  private def emitter(name: String) = head + s"LightSource \"point\" \"spectrum I\" \"$name\"\n"
  private def goniometric(name: String) =
    head + s"LightSource \"goniometric\" \"string filename\" \"$name\"\n"
  private def mesh(name: String) = head + s"Shape \"plymesh\" \"string filename\" \"$name\"\n"
  private def measured(name: String) =
    head + s"Material \"measured\" \"string filename\" \"$name\"\nShape \"sphere\"\n"
  private def fourier(name: String) =
    head.replace("rgb", "image") + s"Material \"fourier\" \"string bsdffile\" \"$name\"\n" +
      "Shape \"sphere\"\n"
  private def lens(name: String) =
    head.replace("\"perspective\"", s"\"realistic\" \"string lensfile\" \"$name\"") +
      "Shape \"sphere\"\n"
  private def cloud(name: String) = head +
    s"MakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" \"$name\"\n" +
    "MediumInterface \"m\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n"
  private def included(name: String) = head + s"Include \"$name\"\n"

  private def mitsuba(content: String) =
    "<scene version=\"3.0.0\"><sensor type=\"perspective\"/>" +
      s"<emitter type=\"constant\"/>\n$content\n</scene>\n"
  private def shape(kind: String)(name: String) =
    mitsuba(s"<shape type=\"$kind\"><string name=\"filename\" value=\"$name\"/></shape>")
  private def volume(name: String) = mitsuba(
    "<shape type=\"cube\"><medium name=\"interior\" type=\"heterogeneous\">" +
      "<volume name=\"sigma_t\" type=\"gridvolume\">" +
      s"<string name=\"filename\" value=\"$name\"/></volume></medium></shape>"
  )

  private def bytes(name: String): Array[Byte] = Files.readAllBytes(Path.of("scenes").resolve(name))

  private val ies = "IESNA:LM-63-2002\r\nTILT=NONE\r\n1 1000 1 3 1 1 2 0 0 0\r\n1 1 50\r\n" +
    "0 45 90\r\n0\r\n100 50 10\r\n"

  private final case class Kind(
      name: String,
      whole: Array[Byte],
      scene: String => String,
      suffix: String = "pbrt"
  )

  private val kinds = Vector(
    Kind("a.png", bytes("textures/chart.png"), texture),
    Kind("b.png", bytes("textures/chart.png"), light),
    Kind("a.exr", bytes("textures/chart.exr"), texture),
    Kind("b.exr", bytes("textures/sky-equalarea.exr"), light),
    Kind("a.hdr", bytes("textures/chart.hdr"), texture),
    Kind("a.tga", bytes("textures/chart.tga").take(15), texture),
    Kind("a.ply", bytes("geometry/torus-le.ply"), mesh),
    Kind("b.ply.gz", Gzip.of(bytes("geometry/cube-ascii.ply")), mesh),
    Kind("a.ies", ies.getBytes, goniometric),
    Kind("a.bsdf", bytes("measured/glossy.bsdf"), measured),
    Kind("b.bsdf", bytes("bsdfs/gloss.bsdf"), fourier),
    Kind("a.nvdb", bytes("volumes/smoke.nvdb"), cloud),
    Kind("a.pbrt.gz", Gzip.of("Shape \"sphere\"\n".repeat(99).getBytes), included),
    Kind("a.serialized", bytes("mitsuba/tent.serialized"), shape("serialized"), "xml"),
    Kind("a.vol", bytes("mitsuba/stripes.vol"), volume, "xml"),
    Kind("c.ply", bytes("mitsuba/tent.ply"), shape("ply"), "xml")
  )

  /** All that is printed of a scene, which is refused. */
  private def messages(folder: Path, text: String, suffix: String): String =
    val scene = Files.writeString(folder.resolve(s"s.$suffix"), text)
    val (code, captured) = Captured.run("check", s"$scene")
    assert(code == ExitCode.BadInput.number, captured.out)
    captured.err

  private def assertPlaced(text: String, folder: Path, suffix: String, name: String): Assertion =
    val first = text.linesIterator.find(_.contains("error: ")).getOrElse(fail(text))
    val place = s"$folder/s.$suffix:"
    assert(first.startsWith(place) && ":\\d+: error: .".r.unanchored.matches(first), text)
    assert(first.contains(name), text)
    assert(!"Exception|java\\.|\\bnull\\b|:0:0".r.unanchored.matches(text), text)

  for kind <- kinds do
    test(s"a cut ${kind.name} is told by place, file and cause"):
      TempFolder.use: folder =>
        val n = kind.whole.length
        // An empty file may be included
        val least = if kind.scene("").contains("Include") then 1 else 0
        for length <- Vector(0, 1, 5, 12, 20, n / 3, n / 2, n - 12) if length >= least do
          Files.write(folder.resolve(kind.name), kind.whole.take(length))
          val text = messages(folder, kind.scene(kind.name), kind.suffix)
          assertPlaced(text, folder, kind.suffix, kind.name)

  test("lenses, spectra and meshes of text that are none are told by place, file and cause"):
    val others = Vector(
      ("a.dat", lens, "pbrt"),
      ("a.spd", emitter, "pbrt"),
      ("a.obj", shape("obj"), "xml"),
      ("a.txt", shape("bsplinecurve"), "xml"),
      (
        "b.spd",
        (name: String) =>
          mitsuba(
            s"<emitter type=\"point\"><spectrum name=\"intensity\" filename=\"$name\"/></emitter>"
          ),
        "xml"
      )
    )
    TempFolder.use: folder =>
      for (name, scene, suffix) <- others; text <- Vector("", "hello\n", "1 2 x\n") do
        Files.writeString(folder.resolve(name), text)
        // An empty file of wavelengths or points has nothing wrong in it for some
        val file = Files.writeString(folder.resolve(s"s.$suffix"), scene(name))
        val (code, captured) = Captured.run("check", s"$file")
        if text.nonEmpty || code != 0 then assertPlaced(captured.err, folder, suffix, name): Unit

  test("a packed scene that is cut says so"):
    TempFolder.use: folder =>
      val whole = Gzip.of((head + "Shape \"sphere\"\n".repeat(5000)).getBytes)
      for length <- Vector(3, 10, 14, whole.length / 2, whole.length - 4) do
        val file = Files.write(folder.resolve("a.pbrt.gz"), whole.take(length))
        val (code, captured) = Captured.run("check", s"$file")
        assert(code == 1)
        assert(captured.err.contains(s"$file") && captured.err.contains("ends too early"))

  private val depths = Image(2, 2, Vector("Z", "id"), Array.fill(8)(1f))

  test("an image without colours is told where it is named, and --keep-going replaces it"):
    TempFolder.use: folder =>
      ImageFiles.write(folder.resolve("z.exr"), depths)
      val mitsubas = "<shape type=\"sphere\"><bsdf type=\"diffuse\">" +
        "<texture name=\"reflectance\" type=\"bitmap\">" +
        "<string name=\"filename\" value=\"z.exr\"/></texture></bsdf></shape>"
      val scenes =
        Vector((texture("z.exr"), "pbrt"), (light("z.exr"), "pbrt"), (mitsuba(mitsubas), "xml"))
      for (text, suffix) <- scenes do
        val told = messages(folder, text, suffix)
        assertPlaced(told, folder, suffix, "z.exr: no channels R, G, B or Y, only ")
        assert(told.endsWith(" --keep-going replaces what is missing with placeholders\n"))
        val (code, captured) = Captured.run("check", "--keep-going", s"$folder/s.$suffix")
        assert(code == 0 && captured.out.contains("1 placeholder"), captured.err)

  test("an image that is decoded although it is cut is a warning with place, file and cause"):
    val whole =
      Vector("a.tga", "a.jpg").map(name => name -> bytes(s"textures/chart${name.drop(1)}"))
    val header = java.nio.ByteBuffer.allocate(54).order(java.nio.ByteOrder.LITTLE_ENDIAN)
    header.put("BM".getBytes).putInt(2, 54 + 64).putInt(10, 54).putInt(14, 40).putInt(18, 4)
      .putInt(22, 4).putShort(26, 1).putShort(28, 32)
    val bitmap = "a.bmp" -> (header.array ++ Array.fill[Byte](64)(99))
    // Packets of one colour and of 20
    val packed = java.nio.ByteBuffer.allocate(18).order(java.nio.ByteOrder.LITTLE_ENDIAN)
    packed.put(2, 10.toByte).putShort(12, 42).putShort(14, 5).put(16, 24.toByte)
    val packets = Vector(21 | 128, 1, 2, 3, 19) ++ Vector.tabulate(60)(_ % 50)
    val runs = "b.tga" -> (packed.array ++ Vector.fill(5)(packets).flatten.map(_.toByte))
    TempFolder.use: folder =>
      val random = scala.util.Random(5)
      val noise = Image(8, 8, Image.RgbNames, Array.fill(192)(random.nextFloat()))
      ImageFiles.write(folder.resolve("a.qoi"), noise)
      val lossless = "a.qoi" -> Files.readAllBytes(folder.resolve("a.qoi"))
      for (name, content) <- whole ++ Vector(bitmap, runs, lossless) do
        val scene = Files.writeString(folder.resolve("s.pbrt"), texture(name))
        def check(count: Int) =
          Files.write(folder.resolve(name), content.take(count))
          val (code, captured) = Captured.run("check", s"$scene")
          assert(code == 0, captured.err)
          captured.err
        assert(check(content.length) == "", name)
        for count <- Vector(content.length * 2 / 3, content.length - 30) do
          val told = check(count)
          assert(
            told.startsWith(s"$scene:5:") && told.contains(s"$name: the file is cut short"),
            told
          )

  test("a whole image with the suffix of another format is not called cut short"):
    TempFolder.use: folder =>
      val png = folder.resolve("a.png")
      ImageFiles.write(png, Image.rgb(3, 2))
      for name <- Vector("b.jpg", "b.jpeg", "b.bmp", "b.tga") do
        val _ = Files.copy(png, folder.resolve(name))
        val scene = Files.writeString(folder.resolve("s.pbrt"), texture(name))
        val (code, captured) = Captured.run("check", s"$scene")
        assert(code == 0 && captured.err == "", name): Unit

  test("view and image blame the image without colours, not their output"):
    TempFolder.use: folder =>
      val file = folder.resolve("z.exr")
      ImageFiles.write(file, depths)
      for words <- Vector(Vector("view"), Vector("image")) do
        val (code, captured) = Captured.run(words ++ Vector(s"$file", "-o", s"$folder/z.png")*)
        assert(code == 1)
        assert(captured.err.startsWith(s"error: $file: no channels R, G, B or Y"), captured.err)

  test("what no statement of the scene says is told at its beginning"):
    TempFolder.use: folder =>
      val scene = Files.writeString(folder.resolve("a.pbrt"), head.replace("rgb", "image"))
      val words = Vector(s"$scene", "--dialect", "v3", "--aov", "direct", "-o", s"$folder/a.exr")
      val (code, captured) = Captured.run(words :+ "--fireflies" :+ "clamp:1"*)
      assert(code == 0, captured.err)
      Files.writeString(folder.resolve("a.pbrt"), head.replace("rgb", "image"))
      val (failed, told) = Captured.run(Vector(s"$scene", "--dialect", "v2") ++ words.drop(3)*)
      assert(failed == 1 && told.err.contains(s"$scene:1:1: error: this integrator"), told.err)

  test("an image that lights with more than sums can hold is refused"):
    TempFolder.use: folder =>
      ImageFiles.write(folder.resolve("a.pfm"), Image(2, 2, Image.RgbNames, Array.fill(12)(2e38f)))
      assertPlaced(messages(folder, light("a.pfm"), "pbrt"), folder, "pbrt", "above 1e30")

  test("resume, merge and bench name what is none of theirs"):
    TempFolder.use: folder =>
      val image = folder.resolve("a.png")
      ImageFiles.write(image, depths.selected(Vector(0, 0, 0)))
      def told(words: String*) = Captured.run(words*)._2.err
      assert(told("resume", s"$image").contains("it is a PNG image, not a saved rendering"))
      assert(told("merge", s"$image", "-o", s"$folder/b.exr").contains("it is a PNG image, not a"))
      assert(told("bench", s"$image").startsWith(s"error: `$image` is a PNG image, not a suite"))
      val scene = Files.writeString(folder.resolve("a.pbrt"), head)
      assert(told("bench", s"$scene").startsWith(s"error: `$scene` is a scene, not a suite"))

  test("check counts the lights of the renderer, and the statements if they are fewer"):
    TempFolder.use: folder =>
      val emitters = head.replace("LightSource \"infinite\"", "LightSource \"point\"") +
        "AreaLightSource \"diffuse\"\nShape \"trianglemesh\" \"integer indices\" [0 1 2 2 1 3] " +
        "\"point3 P\" [0 0 1  2 0 1  0 1 1  1 3 2]\n"
      val scene = Files.writeString(folder.resolve("a.pbrt"), emitters)
      val (code, captured) = Captured.run("check", "--explain", s"$scene")
      assert(code == 0 && captured.out.contains(", 3 lights (of 2 in the file)"), captured.out)
      assert(captured.out.contains("3 lights, sampled"), captured.out)

  test(
    "with the densest volume that is read, --time ends the rendering, and nothing has failed",
    Slow
  ):
    TempFolder.use: folder =>
      val grid = VdbGrid("density", Map((0, 0, 0) -> SampledGrid.MaxValue))
      Files.write(folder.resolve("a.nvdb"), NanoVdb.file(Seq(grid))): Unit
      val volume = "MakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" " +
        "\"a.nvdb\" \"rgb sigma_a\" [0 0 0] \"rgb sigma_s\" [1 1 1]\nMaterial \"interface\"\n" +
        "MediumInterface \"m\" \"\"\nTranslate 0 0 5 Shape \"sphere\" \"float radius\" 4\n"
      val text = s"Integrator \"volpath\" \"integer maxdepth\" 1000000\n$head$volume"
      val scene = Files.writeString(folder.resolve("a.pbrt"), text)
      val (code, captured) =
        Captured.run(s"$scene", "--time", "1s", "--outfile", s"${folder.resolve("a.exr")}")
      assert(code == 0, captured.err)
