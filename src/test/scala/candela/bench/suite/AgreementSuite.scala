package candela.bench.suite

import candela.image.Image

import org.scalatest.funsuite.AnyFunSuite

class AgreementSuite extends AnyFunSuite:

  /** A gradient to the right, with noise of a tenth at each pixel.
    *
    * @param gain by pixel
    */
  private def images(seeds: Range)(gain: (Int, Int) => Float): Vector[Image] =
    seeds.toVector.map: seed =>
      val random = java.util.Random(seed)
      val image = Image.rgb(64, 48)
      for y <- 0 until 48; x <- 0 until 64; c <- 0 until 3 do
        val value = (0.2f + x / 64f) * gain(x, y) * (1 + 0.1f * random.nextGaussian.toFloat)
        image.data((y * 64 + x) * 3 + c) = value
      image

  private val plain = images(1 to 3)((_, _) => 1f)

  test("images that differ by noise alone agree, also a single one"):
    for first <- 10 to 60 by 10 do
      val other = images(first to first + 2)((_, _) => 1f)
      assert(Agreement.broken(other, plain).isEmpty)
      assert(Agreement.broken(other.take(1), plain).isEmpty)

  test("a mean that is 2 % too high is told, with its noise"):
    val found = Agreement.broken(images(11 to 13)((_, _) => 1.02f), plain).get
    // 48·64 pixels of three images: 0.1 / √9216, and as much of the counterpart
    assert(Math.abs(found.share - 0.02) < 0.005 && found.noise < 0.003)
    assert(found.words("that").contains("differs from that of that by +"))

  test("a picture that is mirrored, or wrong in a corner, is told though its mean agrees"):
    val mirrored = images(11 to 13)((x, _) => (0.2f + (63 - x) / 64f) / (0.2f + x / 64f))
    assert(Agreement.broken(mirrored, plain).isDefined)
    val corner = images(11 to 13)((x, y) => if x < 16 && y < 12 then 1.1f else 1f)
    val found = Agreement.broken(corner, plain).get
    assert(found.location == "in pixels 0 to 15, 0 to 11")

  test("an image of another size is told"):
    val found = Agreement.broken(Vector(Image.rgb(8, 8)), plain)
    assert(found.exists(_.words("that").contains("another size")))
