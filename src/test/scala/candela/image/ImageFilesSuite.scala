package candela.image

import candela.io.InputFile
import candela.color.Encoding
import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.{Files, Path}
import scala.jdk.CollectionConverters.*

class ImageFilesSuite extends AnyFunSuite:

  private def error(body: => Any): String =
    intercept[ImageError] { val _ = body }.getMessage

  private def names(folder: Path): Vector[String] =
    val all = Files.list(folder)
    try all.iterator.asScala.map(_.getFileName.toString).toVector.sorted
    finally all.close()

  test("what was written is read back, by the extension's format"):
    Samples.inFolder: folder =>
      val image = Samples.random(12, 9, Image.RgbNames, 1)
      ImageFiles.write(folder.resolve("a.exr"), image)
      ImageFiles.write(folder.resolve("b.PNG"), image, Vector("Scene" -> "x"))
      assert(ImageFiles.read(folder.resolve("a.exr")).data.sameElements(image.data))
      val png = ImageFiles.read(folder.resolve("b.PNG"))
      assert(png.encoding == Encoding.Srgb && png.width == 12)
      assert(names(folder) == Vector("a.exr", "b.PNG"))

  test("contents outrank a wrong extension"):
    Samples.inFolder: folder =>
      ImageFiles.write(folder.resolve("a.png"), Image.rgb(3, 2))
      val renamed = Files.move(folder.resolve("a.png"), folder.resolve("a.exr"))
      assert(ImageFiles.load(InputFile.named(renamed)).isInstanceOf[ByteImage])

  test("a TGA file, which has no mark, is known by its extension"):
    Samples.inFolder: folder =>
      // Type 2, true colour, 2×1 pixels of 24 bits, blue first, from the top.
      val file = Array[Byte](0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 24, 32) ++
        Array[Byte](30, 20, 10, 60, 50, 40)
      val path = Files.write(folder.resolve("a.tga"), file)
      ImageFiles.load(InputFile.named(path)) match
        case image: ByteImage =>
          assert(image.bytes.toVector == Vector[Byte](10, 20, 30, 40, 50, 60))
        case other => fail(s"$other")

  test("PPM, PGM and BMP are read"):
    Samples.inFolder: folder =>
      def read(name: String, header: String, values: Int*) =
        val bytes = header.getBytes("ISO-8859-1") ++ values.map(_.toByte)
        ImageFiles.load(InputFile.named(Files.write(folder.resolve(name), bytes))) match
          case image: ByteImage => (image.channelNames, image.bytes.toVector.map(_ & 255))
          case other => fail(s"$other")
      val pixels = Vector(10, 20, 30, 40, 50, 255)
      assert(read("a.ppm", "P6 2 1 255\n", pixels*) == (Image.RgbNames, pixels))
      assert(read("a.pgm", "P5 3 2 255\n", pixels*) == (Vector("Y"), pixels))
      val header = "BM" + "\u0000" * 8 + "\u001a\u0000\u0000\u0000" + "\u000c\u0000\u0000\u0000" +
        "\u0002\u0000\u0001\u0000\u0001\u0000\u0018\u0000"
      assert(read("a.bmp", header, 30, 20, 10, 255, 50, 40, 0, 0) == (Image.RgbNames, pixels))

  test("a BMP of negative height has its first row on top"):
    val header = Vector('B'.toInt, 'M'.toInt) ++ Vector.fill(8)(0) ++ Vector(54, 0, 0, 0) ++
      Vector(40, 0, 0, 0, 1, 0, 0, 0, 0xfe, 0xff, 0xff, 0xff, 1, 0, 24, 0) ++ Vector.fill(24)(0)
    val bytes = (header ++ Vector(255, 0, 0, 0, 0, 0, 255, 0)).map(_.toByte).toArray
    Samples.inFolder: folder =>
      val image = ImageFiles.read(Files.write(folder.resolve("a.bmp"), bytes))
      assert(image.width == 1 && image.height == 2)
      assert(image.data.toSeq == Seq[Float](0, 0, 1, 1, 0, 0))

  test("errors name the file and what is wrong"):
    Samples.inFolder: folder =>
      def file(name: String, contents: String) =
        Files.write(folder.resolve(name), contents.getBytes)
      val missing = folder.resolve("no.exr")
      assert(error(ImageFiles.read(missing)) == s"$missing: there is no such file")
      val empty = file("empty.png", "")
      assert(error(ImageFiles.read(empty)) == s"$empty: the file is empty")
      val text = file("text.exr", "no picture")
      val wanted = s"$text: not a valid .exr file: its first bytes are wrong"
      assert(error(ImageFiles.read(text)) == wanted)
      assert(error(ImageFiles.read(file("a.tiff", "II*"))).contains("unknown format; EXR, PFM"))
      assert(error(ImageFiles.read(folder)).startsWith(s"$folder: can't be read"))
      assert(error(ImageFiles.read(file("a.tga", "no"))).contains("can't be decoded"))

  test("writing refuses formats it does not know, and names those it does"):
    val image = Image.rgb(1, 1)
    val supported = s"images are written as ${OutputFormat.listed()}"
    def refusal(name: String) = error(ImageFiles.write(Path.of(name), image))
    assert(refusal("a.webp") == s"a.webp: can't write .webp files; $supported")
    assert(refusal("a") == s"a: the name has no extension; $supported")
    assert(OutputFormat.of(Path.of("x/a.Exr")).contains(Exr))
    assert(OutputFormat.of(Path.of("png")).isEmpty)

  test("every format that is written is read back, with what it says that it stores"):
    val names = Image.RgbNames :+ "Z"
    val image = Image(2, 1, names, Array(0.5f, -1f, 3f, 9f, 0f, 0.25f, 1e-3f, 7f))
    for format <- OutputFormat.all do
      Samples.inFolder: folder =>
        val path = folder.resolve(s"a.${format.suffix}")
        ImageFiles.write(path, image)
        assert(OutputFormat.of(path).contains(format))
        // Some formats are for other programs alone
        if ImageFiles.readable.contains(format.suffix) then
          val back = ImageFiles.read(path)
          val holdsAll = format.contents == Contents.Channels
          assert(back.channelNames == (if holdsAll then names else Image.RgbNames))
          val isDisplayed = back.data.forall(v => v >= 0f && v <= 1f)
          assert(isDisplayed == (format.contents == Contents.Display))
          assert(isDisplayed || back.toRgb.data.sameElements(image.toRgb.data)): Unit

  test("suffixes are listed in words"):
    assert(OutputFormat.inWords(Vector(Exr)) == ".exr")
    assert(OutputFormat.inWords(Vector(Exr, Png)) == ".exr or .png")
    assert(OutputFormat.inWords(Vector(Png, Exr, Png)) == ".png, .exr or .png")
    assert(!OutputFormat.listed(Contents.Display).contains(".exr"))

  test("writing replaces a picture"):
    Samples.inFolder: folder =>
      val path = folder.resolve("a.exr")
      ImageFiles.write(path, Image.rgb(1, 1))
      ImageFiles.write(path, Image.rgb(7, 5))
      assert(ImageFiles.read(path).width == 7)
      assert(names(folder) == Vector("a.exr"))

  test("a picture that can't be written leaves the old one and no temporary file"):
    Samples.inFolder: folder =>
      val path = folder.resolve("a.png")
      ImageFiles.write(path, Image.rgb(4, 4))
      val depth = Samples.random(2, 2, Vector("z", "id"), 1)
      assert(error(ImageFiles.write(path, depth)).startsWith(s"$path: no channels"))
      assert(ImageFiles.read(path).width == 4)

      val taken = Files.createDirectory(folder.resolve("b.exr"))
      val inside = Files.createFile(taken.resolve("keep"))
      val black = Image.rgb(1, 1)
      assert(error(ImageFiles.write(taken, black)) == s"can't write `$taken`: it is a folder")
      assert(Files.exists(inside))

      val nowhere = folder.resolve("no/c.exr")
      val why = s"no such folder: `${nowhere.getParent}`"
      assert(error(ImageFiles.write(nowhere, black)) == s"can't write `$nowhere`: $why")
      assert(names(folder) == Vector("a.png", "b.exr"))

  test("a small file that claims to be a huge picture is refused before the memory is taken"):
    def tga(size: Int) =
      val bytes = new Array[Byte](905)
      bytes(2) = 10
      bytes(16) = 24
      for at <- List(12, 14) do
        bytes(at) = size.toByte
        bytes(at + 1) = (size >> 8).toByte
      bytes
    Samples.inFolder: folder =>
      for (size, isRefused) <- List(20000 -> true, 100 -> false) do
        val file = Files.write(folder.resolve("a.tga"), tga(size))
        val answer = Samples.attempt(ImageFiles.load(InputFile.named(file)))
        assert(answer.left.exists(_.endsWith("can't be in a file of 905 bytes")) == isRefused)

  test("pictures of few bits a pixel may be packed far more than others"):
    Samples.inFolder: folder =>
      val kind = java.awt.image.BufferedImage.TYPE_BYTE_BINARY
      val picture = java.awt.image.BufferedImage(6000, 6000, kind)
      val file = folder.resolve("a.png")
      assert(javax.imageio.ImageIO.write(picture, "png", file.toFile))
      assert(Files.size(file) < 6000 * 6000 / 1400)
      assert(ImageFiles.load(InputFile.named(file)).width == 6000)
