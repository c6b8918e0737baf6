package candela.image

import candela.color.Encoding

import org.scalatest.funsuite.AnyFunSuite

import scala.util.Random

class QoiSuite extends AnyFunSuite:

  private def header(width: Int, height: Int, channels: Int, coding: Int): Array[Byte] =
    "qoif".getBytes ++ Array(0, 0, width >> 8, width, 0, 0, height >> 8, height, channels, coding)
      .map(_.toByte)

  private def file(width: Int, height: Int, channels: Int, coding: Int, codes: Int*) =
    header(width, height, channels, coding) ++ codes.map(_.toByte) ++
      Array[Byte](0, 0, 0, 0, 0, 0, 0, 1)

  private def pixels(image: ByteImage): Vector[Vector[Int]] =
    image.bytes.toVector.map(_ & 255).grouped(image.channels).toVector

  test("each code of the specification is read"):
    // Colour, a run of two, differences of 1, 0 and −2, luma 10 with 2 and −3 beside it, and the
    // colour again by its index: (3·10 + 5·20 + 7·30 + 11·255) mod 64 = 9
    val codes = Vector(0xfe, 10, 20, 30, 0xc1, 0x78, 0xaa, 0xa5, 9)
    val image = Qoi.read(file(6, 1, 3, 0, codes*))
    assert(image.encoding == Encoding.Srgb && image.channelNames == Image.RgbNames)
    val wanted = Vector(
      Vector(10, 20, 30),
      Vector(10, 20, 30),
      Vector(10, 20, 30),
      Vector(11, 20, 28),
      Vector(23, 30, 35),
      Vector(10, 20, 30)
    )
    assert(pixels(image) == wanted)

  test("alpha and linear values are read"):
    val image = Qoi.read(file(1, 2, 4, 1, 0xff, 1, 2, 3, 4, 0xc0))
    assert(image.encoding == Encoding.Linear)
    assert(image.channelNames == Image.RgbNames :+ "A")
    assert(pixels(image) == Vector(Vector(1, 2, 3, 4), Vector(1, 2, 3, 4)))

  test("8-bit pictures of every kind come back unchanged"):
    val random = Random(3)
    def near(v: Int, by: Int) = Math.min(255, Math.max(0, v + random.nextInt(2 * by + 1) - by))
    for by <- Vector(0, 1, 6, 255) do
      val values = new Array[Byte](61 * 43 * 3)
      for i <- values.indices do
        values(i) = near(if i < 3 then 9 else values(i - 3) & 255, by).toByte
      val picture = ByteImage(61, 43, Image.RgbNames, values, Encoding.Srgb)
      val file = Qoi.write(picture.toImage, Vector.empty)
      assert(Qoi.read(file).bytes.sameElements(values), s"steps of $by")
      if by == 0 then assert(file.length < 100): Unit

  test("gray is written as colour"):
    val back = Qoi.read(Qoi.write(Image(2, 1, Vector("Y"), Array(0f, 1f)), Vector.empty))
    assert(pixels(back) == Vector(Vector(0, 0, 0), Vector(255, 255, 255)))

  test("faults are named"):
    def refusal(bytes: Array[Byte]) = intercept[ImageError](Qoi.read(bytes)).getMessage
    assert(refusal(header(1, 1, 3, 0)) == "the file is cut short")
    assert(refusal(file(1, 1, 2, 0, 0xc0)) == "2 channels, expected 3 or 4")
    assert(refusal(file(1, 1, 3, 9, 0xc0)) == "unknown colour space 9")
    assert(refusal(file(60000, 50000, 3, 0)).startsWith("60000×50000 pixels can't be in a file of"))
    assert(refusal(file(0, 3, 3, 0)).startsWith("0×3 pixels can't be"))

  test("files that are cut are read as by pbrt-v4, which repeats the last pixel"):
    val whole = Qoi.write(Samples.random(19, 19, Image.RgbNames, 1), Vector.empty)
    assert(!Qoi.isShort(whole))
    val all = Qoi.read(whole).bytes
    for cut <- Vector(20, 100, whole.length / 2) do
      val file = whole.dropRight(cut)
      val bytes = Qoi.read(file).bytes
      val same = bytes.indices.takeWhile(i => bytes(i) == all(i)).size
      // Five bytes a pixel at most; the last eight bytes are taken for the end of the file
      assert(same >= 3 * ((file.length - 14 - 8) / 5) && same < all.length, cut)
      assert(bytes.drop(same).distinct.size <= 3 && Qoi.isShort(file), cut)
    // One run of all pixels; its end alone is missing, and taken from the pixels
    val run = file(9, 5, 3, 0, 0xc0 | 44)
    assert(!Qoi.isShort(run) && Qoi.isShort(run.dropRight(1)))

  test("damaged files are read or refused, never anything else"):
    val file = Qoi.write(Samples.random(19, 19, Image.RgbNames, 1), Vector.empty)
    val all = Samples.damaged(file, 500, seed = 5).map(f => Samples.attempt(Qoi.read(f))).toVector
    assert(all.exists(_.isLeft) && all.exists(_.isRight))
