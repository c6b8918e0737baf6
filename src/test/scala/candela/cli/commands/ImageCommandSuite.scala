package candela.cli.commands

import java.nio.file.{Files, Path}

import org.scalatest.funsuite.AnyFunSuite

import candela.cli.{Captured, Main}
import candela.color.{Encoding, Srgb}
import candela.image.{Image, ImageEdits, ImageFiles, ImageWindow, WriteOptions}
import candela.testing.TempFolder

/** The commands `image`, `average` and `info`. */
class ImageCommandSuite extends AnyFunSuite:

  private def run(words: String*): (Int, Captured) =
    val captured = Captured()
    (Main.run(words, captured.terminal), captured)

  private val sky = "scenes/textures/sky-latlong.exr"
  private val square = "scenes/textures/sky-equalarea.exr"

  /** The image that `candela image` makes of a file. */
  private def made(file: String, words: String*): Image =
    TempFolder.use: folder =>
      val out = folder.resolve("out.exr")
      val (code, captured) = run(Vector("image", file, "--outfile", out.toString) ++ words*)
      assert(code == 0, captured.err)
      ImageFiles.read(out)

  private def refusal(words: String*): String =
    TempFolder.use: folder =>
      val out = folder.resolve("out.exr")
      val (code, captured) = run(Vector("image") ++ words ++ Vector("--outfile", out.toString)*)
      assert(code != 0 && !Files.exists(out))
      captured.err

  private def same(a: Image, b: Image, tolerance: Float) =
    assert((a.width, a.height, a.channelNames) == (b.width, b.height, b.channelNames))
    assert(a.data.zip(b.data).forall((x, y) => Math.abs(x - y) <= tolerance))

  test("image crops, scales and clamps light"):
    val whole = ImageFiles.read(Path.of(sky))
    val part = made(sky, "--crop", "10,40,5,-15", "--scale", "2", "--clamp", "1.5")
    assert((part.width, part.height) == (30, 15))
    for x <- 0 until 30; y <- 0 until 15 do
      val values = Vector.tabulate(3)(c => 2 * whole(10 + x, 5 + y, c))
      val factor = if values.max > 1.5f then 1.5f / values.max else 1f
      for c <- 0 until 3 do assert(Math.abs(part(x, y, c) - values(c) * factor) < 1e-6f): Unit

  test("images of equal images are equal, in whatever folder these are"):
    TempFolder.use: folder =>
      def bytes(command: String, suffix: String, place: String) =
        val source = folder.resolve(place).resolve("sky.exr")
        Files.createDirectories(source.getParent)
        Files.copy(Path.of(sky), source)
        val out = folder.resolve(s"$place.$suffix")
        assert(run(command, s"$source", "--outfile", s"$out")._1 == 0)
        Files.delete(source)
        Files.readAllBytes(out).toVector
      for
        command <- Vector("image", "average", "view")
        suffix <- Vector("png", "jpg", "exr") if command != "view" || suffix != "exr"
      do assert(bytes(command, suffix, "a") == bytes(command, suffix, "b"), s"$command $suffix")

  test("image stores the place of a crop in .exr"):
    TempFolder.use: folder =>
      val out = folder.resolve("crop.exr")
      val (code, captured) =
        run("image", sky, "--crop", "10,40,5,20", "--outfile", out.toString)
      assert(code == 0, captured.err)
      assert(run("info", out.toString)._2.out.contains("x 10 to 40, y 5 to 20 of 64x32"))

  test("the three channels of a layer are the colours of a picture, and keep their names in .exr"):
    TempFolder.use: folder =>
      val (names, values) = (Vector("Z", "N.X", "N.Y", "N.Z"), Array(9f, 0.2f, 0.5f, 1f))
      val file = folder.resolve("layers.exr")
      ImageFiles.write(file, Image(1, 1, names, values))
      def image(out: String): Image =
        val path = folder.resolve(out)
        val words = Vector("image", file.toString, "--channels", "N.X,N.Y,N.Z", "--outfile")
        val (code, captured) = run(words :+ path.toString*)
        assert(code == 0, captured.err)
        ImageFiles.read(path).linear
      same(image("n.pfm"), Image(1, 1, Image.RgbNames, values.drop(1)), 0)
      assert(image("n.exr").channelNames.toSet == names.drop(1).toSet)
      // Half a step of 8 bits at the slope of sRGB's decoding, which is at most 2.3
      same(image("n.png"), Image(1, 1, Image.RgbNames, values.drop(1)), 2.3f / 510)

  test("image resizes by width, height or both"):
    for (size, width, height) <- Vector(("32", 32, 16), ("x8", 16, 8), ("10x30", 10, 30)) do
      val small = made(sky, "--resize", size)
      assert((small.width, small.height) == (width, height))

  test("a list of channels without names is refused"):
    val message = "error: --channels must be at least one name, found none"
    for names <- Vector(",", ",,,") do
      assert(refusal(sky, "--channels", names).startsWith(message))
      val (code, captured) = run("compare", sky, sky, "--channels", names)
      assert(code == 2 && captured.err.startsWith(message))

  test("sizes of more values than an image can have are refused"):
    // As Ints, the first has none, and the second a negative number
    for size <- Vector("65536x65536", "30000x30000") do
      val message = s"${size.replace('x', '×')} pixels of 3 channels are too many for an image"
      assert(refusal(sky, "--resize", size).contains(message))
    for words <- Vector(Vector(square, "--environment", "latlong", "--resize", "65536")) do
      assert(refusal(words*).contains("are too many for an image"))

  test("image turns environment maps into the other shape and back"):
    val whole = ImageFiles.read(Path.of(sky)).toRgb
    val there = made(sky, "--environment", "equalarea", "--resize", "128")
    assert((there.width, there.height) == (128, 128))
    TempFolder.use: folder =>
      val file = folder.resolve("a.exr")
      ImageFiles.write(file, there)
      val back = made(file.toString, "--environment", "latlong", "--resize", "64")
      // Of values up to 12 in a spot of a few pixels, blurred twice
      assert(back.data.zip(whole.data).map((a, b) => Math.abs(a - b).toDouble).sum /
        whole.data.length < 0.02)
      val truth = ImageFiles.read(Path.of(square)).toRgb
      same(made(sky, "--environment", "equalarea"), truth, 2.5f)

  test("image writes any format, 16-bit floats and other primaries"):
    TempFolder.use: folder =>
      val files = Vector("a.png", "b.pfm", "c.qoi", "d.exr").map(folder.resolve(_).toString)
      val words = Vector("image", sky, "--half", "--colorspace", "rec2020", "--flip", "--outfile")
      val (code, captured) = run(words :+ files.mkString(",")*)
      assert(code == 0 && captured.out.linesIterator.size == 4, captured.err)
      val exr = ImageFiles.read(Path.of(files(3)))
      assert(exr.colorSpace.name == "rec2020")
      val whole = ImageFiles.read(Path.of(sky)).toRgb
      // Half floats have 11 bits: they are off by up to 5e-4 of the value
      assert(Math.abs(exr.toRgb(3, 31, 2) - whole(3, 0, 2)) < 1e-3f)
      assert(ImageFiles.facts(Path.of(files(3))).toMap.apply("image") == "sky-latlong.exr")

  /** The picture that `candela image` makes of an EXR file. */
  private def picture(image: Image, suffix: String, words: String*): Image =
    TempFolder.use: folder =>
      val (file, out) = (folder.resolve("a.exr"), folder.resolve(s"out.$suffix"))
      ImageFiles.write(file, image)
      val (code, captured) = run(Vector("image", s"$file", "--outfile", s"$out") ++ words*)
      assert(code == 0, captured.err)
      val again = folder.resolve(s"again.$suffix")
      assert(run("image", s"$out", "--outfile", s"$again")._1 == 0)
      val made = ImageFiles.read(out)
      assert(suffix == "jpg" || ImageFiles.read(again).data.toVector == made.data.toVector)
      made.linear

  test("a picture of an image with denoised colours shows these"):
    val names = Image.RgbNames ++ Vector("Denoised.R", "Denoised.G", "Denoised.B")
    val image = Image(1, 1, names, Array(1f, 1f, 1f, 0.2f, 0.5f, 0.8f))
    def shown(r: Float, g: Float, b: Float) = Image(1, 1, Image.RgbNames, Array(r, g, b))
    for suffix <- Vector("png", "tga", "qoi") do
      same(picture(image, suffix), shown(0.2f, 0.5f, 0.8f), 2.3f / 510)
      same(picture(image, suffix, "--colorspace", "rec2020"), shown(0.2f, 0.5f, 0.8f), 0.01f)
      same(picture(image, suffix, "--channels", "R,G,B"), shown(1, 1, 1), 2.3f / 510)

  test("a picture has the alpha of its image, if its format keeps that"):
    val image = Image(1, 1, Image.RgbNames :+ "A", Array(0.1f, 0.2f, 0.4f, 0.5f))
    val straight = Image(1, 1, image.channelNames, Array(0.2f, 0.4f, 0.8f, 0.5f))
    for suffix <- Vector("png", "tga") do same(picture(image, suffix), straight, 2.3f / 510)
    val opaque = Image(1, 1, Image.RgbNames, image.data.take(3))
    same(picture(image, "qoi"), opaque, 2.3f / 510)

  /** Red, green, blue and alpha; where that is 0, nothing shows a colour. */
  private val translucent: Image =
    val pixels =
      for alpha <- 0 to 255 by 15; c <- 0 to 3 yield
        val color = if alpha == 0 then Vector(0, 0, 0) else Vector(80 * c, 255 - 80 * c, 128)
        (color :+ alpha).map(_ / 255f)
    Image(4, 18, Image.RgbNames :+ "A", pixels.flatten.toArray, Encoding.Srgb)

  test("a transparent picture of 8 bits becomes an EXR file and the same picture again"):
    TempFolder.use: folder =>
      def file(name: String) = folder.resolve(name)
      for suffix <- Vector("png", "tga") do
        val (first, exr, again) = (file(s"a.$suffix"), file("b.exr"), file(s"c.$suffix"))
        val opacity = Array.tabulate(4 * 18)(i => translucent.data(4 * i + 3))
        ImageFiles.write(first, translucent, options = WriteOptions(alpha = Some(opacity)))
        assert(run("image", s"$first", "--outfile", s"$exr")._1 == 0)
        assert(run("image", s"$exr", "--outfile", s"$again")._1 == 0)
        same(ImageFiles.read(again), ImageFiles.read(first), 0)
        same(ImageFiles.read(again), translucent, 1e-6f)
        // Channels of an EXR file are in alphabetical order
        val light = ImageEdits.select(ImageFiles.read(exr), translucent.channelNames)
        assert(Math.abs(light(3, 9, 0) - Srgb.decode(240 / 255f) * 135 / 255f) < 1e-5f)

  test("averages of transparent and denoised images show alpha and the denoised colours"):
    TempFolder.use: folder =>
      val names = (Image.RgbNames :+ "A") ++ Vector("Denoised.R", "Denoised.G", "Denoised.B")
      val files = Vector(0f, 0.2f).map: v =>
        val file = folder.resolve(s"$v.exr")
        ImageFiles.write(file, Image(1, 1, names, Array(1f, v, 1f, 0.4f + v, 0.1f, v, 0.4f)))
        file.toString
      def mean(name: String, sources: Vector[String] = files) =
        val out = folder.resolve(name)
        val (code, captured) = run(Vector("average") ++ sources ++ Vector("--outfile", s"$out")*)
        assert(code == 0, captured.err)
        ImageFiles.read(out).linear
      val straight = Image(1, 1, Image.RgbNames :+ "A", Array(0.2f, 0.2f, 0.8f, 0.5f))
      same(mean("a.png"), straight, 2.3f / 510)
      assert(mean("a.exr").channelNames.toSet == names.toSet)
      val picture = folder.resolve("a.png").toString
      same(mean("b.png", Vector(picture, picture)), straight, 2.3f / 510)

  test("an image of an image keeps its metadata and its place"):
    TempFolder.use: folder =>
      val (file, out) = (folder.resolve("a.exr"), folder.resolve("out.exr"))
      val window = Some(ImageWindow(1, 2, 30, 20))
      val image = Image(1, 1, Image.RgbNames, Array(1f, 2f, 3f))
      val texts = Vector("image" -> "b.exr", "seed" -> "3")
      ImageFiles.write(file, image, texts, WriteOptions(window = window))
      assert(run("image", s"$file", "--outfile", s"$out")._1 == 0)
      assert(ImageFiles.about(out) == (window, Vector("image" -> "a.exr", "seed" -> "3")))

  test("archives of arrays are written, not read"):
    TempFolder.use: folder =>
      val file = folder.resolve("a.npz").toString
      assert(run("image", sky, "--outfile", file)._1 == 0)
      for (code, captured) <- Vector(run("compare", sky, file), run("info", file)) do
        assert(code != 0 && captured.err.contains(".npz files are written, not read"), captured.err)

  test("image refuses what can't be, and says why"):
    assert(refusal(sky, "--crop", "0,100,0,10").contains(s"$sky: window x 0 to 100"))
    assert(refusal(sky, "--channels", "Q").contains(s"$sky: no channel Q, only R, G, B"))
    assert(refusal(sky, "--environment", "latlong").contains("square, found 64x32 pixels"))
    assert(refusal(sky, "--resize", "0").contains("must be WIDTHxHEIGHT"))
    assert(refusal(sky, "--scale", "0").contains("--scale must be above 0"))
    assert(refusal("nowhere.exr").contains("nowhere.exr: there is no such file"))

  test("an image is not written as a film"):
    TempFolder.use: folder =>
      val film = folder.resolve("out.film").toString
      for words <- Vector(Vector("image", sky), Vector("average", sky, sky), Vector("view", sky)) do
        val (code, captured) = run(words ++ Vector("--outfile", film)*)
        assert(code == 1 && captured.err.contains("[E0106]"), captured.err)
        assert(!Files.exists(Path.of(film)))

  test("average is the mean of images"):
    TempFolder.use: folder =>
      val files = Vector(1f, 2f, 6f).map: v =>
        val file = folder.resolve(s"$v.exr")
        ImageFiles.write(file, Image(1, 1, Vector("R", "G", "B", "z"), Array(v, 0f, 1f, 2 * v)))
        file.toString
      val out = folder.resolve("mean.exr")
      val (code, captured) = run(Vector("average") ++ files ++ Vector("--outfile", out.toString)*)
      assert(code == 0 && captured.out.contains("mean of 3 images"), captured.err)
      assert(ImageFiles.read(out).data.toVector == Vector(3f, 0f, 1f, 6f))
      val (other, why) = run("average", files.head, sky, "--outfile", out.toString)
      assert(other == 1 && why.err.contains("differ in size"))

  test("info prints size, channels, metadata and statistics"):
    TempFolder.use: folder =>
      val file = folder.resolve("a.exr")
      val data = Array(1f, Float.NaN, 3f, Float.PositiveInfinity)
      ImageFiles.write(file, Image(2, 1, Vector("Y", "z"), data), Vector("scene" -> "küche"))
      val (code, captured) = run("info", file.toString)
      assert(code == 0)
      val lines = captured.out.linesIterator.map(_.trim.split(" {2,}").toVector).toVector
      assert(lines.contains(Vector("size", "2x1")))
      assert(lines.contains(Vector("channels", "Y, z, floats, linear")))
      assert(lines.contains(Vector("scene", "küche")))
      assert(lines.contains(Vector("Y", "1.000", "3.000", "2.000", "0", "0")))
      assert(lines.contains(Vector("z", "-", "-", "-", "1", "1")))
      def precision(name: String, words: String*) =
        val copy = folder.resolve(name).toString
        assert(run((Vector("image", "scenes/textures/chart.png", "-o", copy) ++ words)*)._1 == 0)
        run("info", copy)._2.out.linesIterator.find(_.startsWith("channels")).get
      assert(precision("half.exr", "--half").endsWith(", half, linear"))
      assert(precision("deep.png", "--bits", "16").endsWith(", 16 bits, srgb"))
      val (both, pair) = run("info", file.toString, "scenes/textures/chart.png")
      assert(both == 0 && pair.out.contains("scenes/textures/chart.png\nsize"))
      assert(pair.out.contains("8 bits, srgb"))
      assert(run("info", "nowhere.exr")._1 == 1)
