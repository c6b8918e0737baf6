package candela.image

import org.scalatest.funsuite.AnyFunSuite

import java.nio.{ByteBuffer, ByteOrder}

class PfmSuite extends AnyFunSuite:

  private def file(header: String, order: ByteOrder, values: Float*): Array[Byte] =
    val bytes = ByteBuffer.allocate(4 * values.size).order(order)
    values.foreach(bytes.putFloat)
    header.getBytes ++ bytes.array

  test("a negative scale means little-endian, and rows run from the bottom"):
    val values = Vector.tabulate(12)(_ - 3.5f)
    for (scale, order) <- Vector(-1 -> ByteOrder.LITTLE_ENDIAN, 1 -> ByteOrder.BIG_ENDIAN) do
      val image = Pfm.read(file(s"PF\n2 2\n$scale\n", order, values*))
      assert((image.width, image.height, image.channelNames) == (2, 2, Image.RgbNames))
      assert(image.data.toVector == values.drop(6) ++ values.take(6))

  test("gray maps have one channel"):
    val image = Pfm.read(file("Pf 1 3 -1.000000 ", ByteOrder.LITTLE_ENDIAN, 1f, 2f, 3f))
    assert(image.channelNames == Vector("Y"))
    assert(image.data.toVector == Vector(3f, 2f, 1f))

  test("the scale is a factor, and the header may have Windows line ends"):
    val image = Pfm.read(file("Pf\r\n2 1\r\n-0.5\r\n", ByteOrder.LITTLE_ENDIAN, 1f, 2f))
    assert(image.data.toVector == Vector(0.5f, 1f))

  test("every float comes back, in colour and gray"):
    for names <- Vector(Image.RgbNames, Vector("Y")) do
      val image = Samples.random(7, 5, names, 3)
      image.data(4) = Float.PositiveInfinity
      image.data(5) = -1e-40f
      val back = Pfm.read(Pfm.write(image, Vector.empty))
      assert(back.channelNames == names && back.data.sameElements(image.data))

  test("faults are named"):
    def refusal(header: String, values: Float*) =
      intercept[ImageError](Pfm.read(file(header, ByteOrder.LITTLE_ENDIAN, values*))).getMessage
    assert(refusal("PF\n2 2\n-1\n", 1f) == "2×2 pixels need 48 bytes, found 4")
    assert(refusal("PF\n99999 99999\n-1\n").contains("pixels need 119997600012 bytes"))
    assert(refusal("PF\n-1 2\n-1\n") == "expected a size, found `-1`")
    assert(refusal("PF\n1 1\n0\n", 1f, 1f, 1f) == "expected a scale such as -1, found `0`")
    assert(refusal("PF\n1") == "its header has no width")
    assert(refusal("PF\n1 " + "9" * 99) == "its header has no height")

  test("damaged files are read or refused, never anything else"):
    val file = Pfm.write(Samples.random(9, 9, Image.RgbNames, 1), Vector.empty)
    val outcomes = Samples.damaged(file, 500, seed = 5).map: f =>
      Samples.attempt(Pfm.read(f))
    val all = outcomes.toVector
    assert(all.exists(_.isLeft) && all.exists(_.isRight))
