package candela.image

import candela.color.{Encoding, Gamut, Srgb}
import org.scalatest.funsuite.AnyFunSuite

import java.awt.image.BufferedImage
import java.io.ByteArrayOutputStream
import javax.imageio.ImageIO

class PngSuite extends AnyFunSuite:

  private def read(bytes: Array[Byte]): StoredImage = StbReader.read(bytes)

  test("linear colours come back as the nearest of the 256 sRGB codes"):
    val image = Samples.random(61, 47, Image.RgbNames, seed = 5)
    val back = read(Png.write(image, Vector.empty)).toImage
    assert(back.encoding == Encoding.Srgb)
    val displayed = image.mapped(Gamut.desaturate)
    for i <- image.data.indices do
      val wanted = Srgb.encode(Math.min(1f, displayed.data(i)))
      // Half a code, and the roundings of 255·x in Float.
      assert(Math.abs(back.data(i) - wanted) <= 0.5f / 255f + 1e-6f, s"number $i")

  test("a chunk whose checksum is wrong is damage, but for one that may be left out"):
    val good = Png.write(Samples.random(20, 30, Image.RgbNames, seed = 5), Vector.empty)
    def nameOf(i: Int) = String(good, i, 4, java.nio.charset.StandardCharsets.ISO_8859_1)
    val data = good.indices.find(nameOf(_) == "IDAT").get
    val bad = good.clone()
    bad(data + 20) = (bad(data + 20) ^ 0xff).toByte
    val error = intercept[ImageError](read(bad))
    assert(
      error.getMessage.contains(s"the checksum of the chunk IDAT at byte ${data - 4} is wrong")
    )
    // A text chunk before it, with a checksum of 0
    val text = Array[Byte](0, 0, 0, 3) ++ "tEXtA\u0000b".getBytes ++ new Array[Byte](4)
    val back = read(good.take(data - 4) ++ text ++ good.drop(data - 4)).toImage
    assert(back.data.sameElements(read(good).toImage.data))
    // One that is cut short is left to the decoder
    assert(
      intercept[ImageError](read(good.take(data + 40))).getMessage.contains("can't be decoded")
    )

  test("NaN is black, infinity white"):
    val data = Array(Float.NaN, Float.PositiveInfinity, Float.NegativeInfinity)
    val back = read(Png.write(Image(1, 1, Image.RgbNames, data), Vector.empty)).toImage
    assert(back.data.toVector == Vector(0f, 1f, 0f))

  test("a picture read from 8 bits is written unchanged"):
    val codes = Array.tabulate(256 * 3)(i => (i / 3).toByte)
    val picture = ByteImage(16, 16, Image.RgbNames, codes, Encoding.Srgb)
    read(Png.write(picture.toImage, Vector.empty)) match
      case back: ByteImage => assert(back.bytes.sameElements(codes))
      case other => fail(s"$other")

  test("luminance is written as gray"):
    val back = read(Png.write(Image(2, 1, Vector("Y"), Array(0f, 1f)), Vector.empty))
    assert(back.channelNames == Vector("Y"))
    assert(back.toImage.data.toVector == Vector(0f, 1f))

  test("other channels are left out; without colour it is an error"):
    val back = read(Png.write(Samples.random(3, 3, Vector("z", "B", "G", "R"), 1), Vector.empty))
    assert(back.channelNames == Image.RgbNames)
    val depth = Samples.random(3, 3, Vector("depth", "id"), 1)
    val error = intercept[ImageError](Png.write(depth, Vector.empty))
    assert(error.getMessage == "no channels R, G, B or Y, only depth, id")
    val alone = read(Png.write(Image(1, 1, Vector("depth"), Array(1f)), Vector.empty))
    assert(alone.channelNames == Vector("Y") && alone.toImage.data(0) == 1f)

  test("alpha is stored as it is, in 8 or 16 bits, beside encoded colours"):
    val alpha = Some(Array(0f, 0.25f, 2f))
    val image = Image(3, 1, Image.RgbNames, Array.tabulate(9)(_ / 8f))
    for bits <- Seq(8, 16) do
      val how = WriteOptions(display = DisplayTransform(bits = bits), alpha = alpha)
      val back = read(Png.write(image, Vector.empty, how)).toImage
      assert(back.channelNames == Image.RgbNames :+ "A")
      // Half a code of 8 bits
      for (value, i) <- Seq(0f, 0.25f, 1f).zipWithIndex do
        assert(Math.abs(back(i, 0, 3) - value) <= 0.5f / 255, bits)
        for c <- 0 until 3 do
          assert(Math.abs(back(i, 0, c) - Srgb.encode(image(i, 0, c))) <= 0.51f / 255, bits)

  test("metadata is stored as text"):
    val file = Png.write(Image.rgb(1, 1), Vector("Software" -> "Candela 0.1", "Scene" -> "küche"))
    val plain = String(file, "UTF-8")
    assert(plain.contains("iTXtSoftware") && plain.contains("Candela 0.1"))
    assert(plain.contains("küche"))
    assert(plain.contains("sRGB"))

  private def made(kind: Int, format: String): Array[Byte] =
    val picture = BufferedImage(5, 3, kind)
    for y <- 0 until 3; x <- 0 until 5 do
      picture.getRaster.setPixel(x, y, Array.tabulate(4)(c => 40 * x + 20 * y + c))
    val out = ByteArrayOutputStream()
    assert(ImageIO.write(picture, format, out))
    out.toByteArray

  test("gray, colour and alpha of 8 bits are read with their channels, as bytes"):
    for (kind, names) <- Vector(
        BufferedImage.TYPE_BYTE_GRAY -> Vector("Y"),
        BufferedImage.TYPE_INT_RGB -> Image.RgbNames,
        BufferedImage.TYPE_INT_ARGB -> (Image.RgbNames :+ "A")
      )
    do
      read(made(kind, "png")) match
        case image: ByteImage =>
          assert(image.channelNames == names)
          for y <- 0 until 3; x <- 0 until 5; c <- names.indices do
            assert((image.bytes((y * 5 + x) * names.size + c) & 0xff) == 40 * x + 20 * y + c)
        case other => fail(s"$other")

  test("16 bits keep their precision"):
    val picture = BufferedImage(5, 3, BufferedImage.TYPE_USHORT_GRAY)
    for y <- 0 until 3; x <- 0 until 5 do picture.getRaster.setSample(x, y, 0, 12345 * x + y)
    val out = ByteArrayOutputStream()
    assert(ImageIO.write(picture, "png", out))
    val image = read(out.toByteArray).toImage
    for y <- 0 until 3; x <- 0 until 5 do assert(image(x, y, 0) == (12345 * x + y) / 65535f)

  test("JPEG is read"):
    val image = read(made(BufferedImage.TYPE_INT_RGB, "jpg"))
    assert((image.width, image.height, image.channelNames) == (5, 3, Image.RgbNames))

  test("damaged files are read or refused, never anything else"):
    val files = Vector(
      Png.write(Samples.random(40, 30, Image.RgbNames, 1), Vector.empty),
      made(BufferedImage.TYPE_INT_RGB, "jpg")
    )
    val outcomes = files.flatMap: file =>
      Samples.damaged(file, 300, seed = file.length).map(f => Samples.attempt(read(f)))
    assert(outcomes.exists(_.isLeft))
    assert(outcomes.exists(_.isRight))
