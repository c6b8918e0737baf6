package candela.image

import candela.color.Encoding

import org.scalatest.funsuite.AnyFunSuite

import java.nio.file.Files

class TgaSuite extends AnyFunSuite:

  test("an 8-bit picture comes back unchanged, from the top"):
    val codes = Array.tabulate(5 * 300 * 3)(i => (7 * i + i / 256).toByte)
    val picture = ByteImage(5, 300, Image.RgbNames, codes, Encoding.Srgb)
    StbReader.read(Tga.write(picture.toImage, Vector.empty)) match
      case back: ByteImage =>
        assert((back.width, back.height, back.channelNames) == (5, 300, Image.RgbNames))
        assert(back.bytes.sameElements(codes))
      case other => fail(s"$other")

  test("alpha is a fourth byte"):
    val how = WriteOptions(alpha = Some(Array(0f, 1f)))
    val back = StbReader.read(Tga.write(Image.rgb(2, 1), Vector.empty, how))
    assert(back.channelNames == Image.RgbNames :+ "A")
    assert(back.toImage.data.toVector == Vector(0f, 0f, 0f, 0f, 0f, 0f, 0f, 1f))

  test("gray is written as colour"):
    val back = StbReader.read(Tga.write(Image(2, 1, Vector("Y"), Array(0f, 1f)), Vector.empty))
    assert(back.toImage.data.toVector == Vector(0f, 0f, 0f, 1f, 1f, 1f))

  test("sizes that the format can't hold are refused"):
    val wide = Image.rgb(65536, 1)
    val message = intercept[ImageError](Tga.write(wide, Vector.empty)).getMessage
    assert(message == "TGA holds at most 65535×65535 pixels, found 65536×1")

  private def header(kind: Int, bits: Int, flags: Int, palette: (Int, Int) = (0, 0)) =
    val (first, count) = palette
    Vector(0, if count > 0 then 1 else 0, kind, first, 0, count, 0, if count > 0 then 24 else 0) ++
      Vector(0, 0, 0, 0, 2, 0, 2, 0, bits, flags)

  private def read(values: Vector[Int]): Vector[Int] =
    Samples.inFolder: folder =>
      val file = Files.write(folder.resolve("a.tga"), values.map(_.toByte).toArray)
      ImageFiles.read(file).data.toVector.map(v => Math.round(v * 255))

  test("rows and columns run from any corner"):
    val greys = Vector(1, 2, 3, 4)
    val found = Vector(0, 0x10, 0x20, 0x30).map(flags => read(header(3, 8, flags) ++ greys))
    assert(found == Vector(Vector(3, 4, 1, 2), Vector(4, 3, 2, 1), greys, Vector(2, 1, 4, 3)))

  test("a palette may begin with a later entry than 0"):
    val palette = Vector(3, 2, 1, 6, 5, 4)
    val wanted = Vector(1, 2, 3, 4, 5, 6, 4, 5, 6, 1, 2, 3)
    assert(read(header(1, 8, 0x20, (0, 2)) ++ palette ++ Vector(0, 1, 1, 0)) == wanted)
    assert(read(header(1, 8, 0x20, (7, 2)) ++ palette ++ Vector(7, 8, 8, 7)) == wanted)
    def remark(palette: (Int, Int)) = Tga.remark(header(1, 8, 0, palette).map(_.toByte).toArray)
    assert(remark((0, 2)).isEmpty && remark((7, 2)).exists(_.contains("begins with entry 7")))

  test("headers that are cut off are errors"):
    val whole = header(1, 8, 0x30, (7, 2))
    for length <- 1 to whole.size do intercept[ImageError](read(whole.take(length)))
