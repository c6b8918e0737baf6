package candela.image

import candela.color.Encoding

import org.scalatest.funsuite.AnyFunSuite

class TgaSuite extends AnyFunSuite:

  test("an 8-bit picture comes back unchanged, from the top"):
    val codes = Array.tabulate(5 * 300 * 3)(i => (7 * i + i / 256).toByte)
    val picture = ByteImage(5, 300, Image.RgbNames, codes, Encoding.Srgb)
    StbReader.read(Tga.write(picture.toImage, Vector.empty)) match
      case back: ByteImage =>
        assert((back.width, back.height, back.channelNames) == (5, 300, Image.RgbNames))
        assert(back.bytes.sameElements(codes))
      case other => fail(s"$other")

  test("gray is written as colour"):
    val back = StbReader.read(Tga.write(Image(2, 1, Vector("Y"), Array(0f, 1f)), Vector.empty))
    assert(back.toImage.data.toVector == Vector(0f, 0f, 0f, 1f, 1f, 1f))

  test("sizes that the format can't hold are refused"):
    val wide = Image.rgb(65536, 1)
    val message = intercept[ImageError](Tga.write(wide, Vector.empty)).getMessage
    assert(message == "TGA holds at most 65535×65535 pixels, found 65536×1")
