package candela.image

import org.scalatest.funsuite.AnyFunSuite

import java.io.ByteArrayOutputStream
import scala.util.Random

class HdrSuite extends AnyFunSuite:

  private type Pixels = Vector[Vector[(Int, Int, Int, Int)]]

  /** Mantissas as writers normalise them, the largest at least 128; runs long and short. */
  private def pixels(width: Int, height: Int, seed: Int): Pixels =
    val random = Random(seed)
    def pixel() =
      val exponent = 100 + random.nextInt(60)
      (128 + random.nextInt(128), random.nextInt(256), random.nextInt(256), exponent)
    def length() = 1 + random.nextInt(if random.nextBoolean() then 3 else 300)
    Vector.fill(height):
      Iterator
        .continually(Vector.fill(length())(pixel()))
        .map(run => if random.nextBoolean() then run.map(_ => run.head) else run)
        .flatten
        .take(width)
        .toVector

  private def header(size: String, format: String = "32-bit_rle_rgbe"): Array[Byte] =
    s"#?RADIANCE\n# made by hand\nFORMAT=$format\nEXPOSURE=2\n\n$size\n".getBytes("US-ASCII")

  private def size(p: Pixels): String = s"-Y ${p.size} +X ${p.head.size}"

  private def flat(p: Pixels): Array[Byte] =
    header(size(p)) ++ p.flatten.flatMap((r, g, b, e) => Vector(r, g, b, e)).map(_.toByte)

  private def encoded(p: Pixels): Array[Byte] =
    val out = ByteArrayOutputStream()
    out.writeBytes(header(size(p)))
    for row <- p do
      out.writeBytes(Array(2, 2, (row.size >> 8).toByte, row.size.toByte))
      for part <- Vector[((Int, Int, Int, Int)) => Int](_._1, _._2, _._3, _._4) do
        var rest = row.map(part)
        while rest.nonEmpty do
          val run = rest.takeWhile(_ == rest.head).take(127)
          if run.size > 2 then
            out.writeBytes(Array((128 + run.size).toByte, run.head.toByte))
            rest = rest.drop(run.size)
          else
            val some = rest.take(128)
            out.write(some.size)
            some.foreach(out.write(_))
            rest = rest.drop(some.size)
    out.toByteArray

  private def value(mantissa: Int, e: Int): Float = (mantissa * Math.pow(2, e - 136)).toFloat

  private def assertHolds(image: Image, p: Pixels): Unit =
    assert((image.width, image.height) == (p.head.size, p.size))
    for (row, y) <- p.zipWithIndex; ((r, g, b, e), x) <- row.zipWithIndex do
      assert(image(x, y, 0) == value(r, e), s"at $x, $y")
      assert(image(x, y, 1) == value(g, e), s"at $x, $y")
      assert(image(x, y, 2) == value(b, e), s"at $x, $y")

  test("flat files are read exactly"):
    for width <- Vector(1, 7, 8, 100, 700) do
      val p = pixels(width, 5, width)
      assertHolds(Hdr.read(flat(p)), p)

  test("run-length encoded files are read exactly"):
    for width <- Vector(8, 100, 700, 5000) do
      val p = pixels(width, 5, width)
      assertHolds(Hdr.read(encoded(p)), p)

  test("the old runs repeat the last pixel, successive counts weighing 256 times more"):
    val first = Vector(200, 100, 50, 130)
    val body = first ++ Vector(1, 1, 1, 44) ++ Vector(1, 1, 1, 1) ++ Vector(128, 3, 4, 128)
    val image = Hdr.read(header("-Y 1 +X 302") ++ body.map(_.toByte))
    for x <- 0 to 300 do assert(image(x, 0, 0) == value(200, 130), s"at $x")
    assert(image(301, 0, 0) == value(128, 128))

  test("exponent 0 is black"):
    val image = Hdr.read(header("-Y 1 +X 1") ++ Array[Byte](9, 9, 9, 0))
    assert(image.data.forall(_ == 0f))

  test("rows from the bottom and columns from the right are turned around"):
    val p = pixels(9, 4, 3)
    val body = flat(p).drop(header(size(p)).length)
    assertHolds(Hdr.read(header("+Y 4 +X 9") ++ body), p.reverse)
    assertHolds(Hdr.read(header("-Y 4 -X 9") ++ body), p.map(_.reverse))

  test("what is not supported is refused by name"):
    def refusal(file: Array[Byte]) = Samples.attempt(Hdr.read(file)).swap.toOption.get
    assert(refusal(header("-Y 1 +X 1", "32-bit_rle_xyze")).contains("32-bit_rle_xyze"))
    assert(refusal(header("+X 4 -Y 4")).contains("found `+X 4 -Y 4`"))
    assert(refusal(header("-Y 99999 +X 99999")).contains("99999×99999 pixels can't be in a file"))
    assert(refusal("#?RADIANCE\nFORMAT=x".getBytes).contains("header does not end"))

  test("damaged files are read or refused, never anything else"):
    val files = Vector(flat(pixels(40, 6, 1)), encoded(pixels(700, 6, 2)))
    val outcomes = files.flatMap: file =>
      Samples.damaged(file, 1500, seed = file.length).map(f => Samples.attempt(Hdr.read(f)))
    assert(outcomes.exists(_.isLeft))
    assert(outcomes.exists(_.isRight))
