package candela.report

import candela.image.Image

import org.scalatest.funsuite.AnyFunSuite

import java.util.Base64
import java.util.zip.InflaterInputStream

class PackedPictureSuite extends AnyFunSuite:

  private def unpacked(text: String): Array[Byte] =
    val bytes = java.io.ByteArrayInputStream(Base64.getDecoder.decode(text))
    InflaterInputStream(bytes).readAllBytes()

  test("numbers come back to 2⁻¹⁶ of their value, planes of bytes after one another"):
    val values =
      Array(0f, 1f, -1f, 0.1f, 1e-20f, 123456.78f, 3.4e38f, 0.333333f, 65504f, 2f, 7f, 9f)
    val image = Image(2, 2, Image.RgbNames, values)
    val bytes = unpacked(PackedPicture.floats(image))
    assert(bytes.length == 36)
    for i <- values.indices do
      val bits = (0 until 3).map(p => (bytes(p * 12 + i) & 0xff) << (24 - 8 * p)).sum
      val found = java.lang.Float.intBitsToFloat(bits)
      assert(Math.abs(found - values(i)) <= Math.abs(values(i)) / 65536, values(i))

  test("maps have 8 bits, and are clamped"):
    val map = Image(4, 1, Vector("Y"), Array(-1f, 0.5f, 1f, 3f))
    assert(unpacked(PackedPicture.bytes(map)).map(_ & 0xff).toVector == Vector(0, 128, 255, 255))

  test("large pictures are halved, and keep their mean"):
    val image = Image.rgb(8, 6)
    for i <- image.data.indices do image.data(i) = i.toFloat
    val small = PackedPicture.reduced(image, limit = 12)
    assert((small.width, small.height) == (4, 3))
    // Means of four: the first ones are 0, 3, 24 and 27.
    assert(small(0, 0, 0) == 13.5f)
    assert(small.data.sum / small.data.length == image.data.sum / image.data.length)
    assert(PackedPicture.reduced(image, limit = 48) eq image)
