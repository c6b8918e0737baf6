package candela.convert

import java.lang.Double.longBitsToDouble
import java.lang.Float.{floatToRawIntBits, intBitsToFloat}

import scala.util.Random

import org.scalatest.funsuite.AnyFunSuite

class NumberTextSuite extends AnyFunSuite:

  test("numbers look as people write them"):
    val known = Vector(
      0f -> "0",
      -0f -> "-0",
      1f -> "1",
      -45f -> "-45",
      0.1f -> "0.1",
      1f / 3 -> "0.33333334",
      0.002f -> "0.002",
      1e-7f -> "1e-7",
      1e30f -> "1e30",
      1.5e20f -> "1.5e20",
      16777216f -> "16777216",
      1234567.5f -> "1234567.5"
    )
    for (value, text) <- known do assert(NumberText.of(value) == text)
    assert(NumberText.of(0.1) == "0.1" && NumberText.of(Math.PI) == "3.141592653589793")

  test("every number is read back, with no digit too many"):
    val random = Random(1)
    val floats = Vector.fill(20000)(intBitsToFloat(random.nextInt())).filter(_.abs < 1e38f)
    for f <- floats do
      val text = NumberText.of(f)
      assert(floatToRawIntBits(text.toFloat) == floatToRawIntBits(f))
      assert(digits(text) <= 9)
    val doubles = Vector.fill(20000)(longBitsToDouble(random.nextLong())).filter(_.abs < 1e308)
    for d <- doubles do assert(NumberText.of(d).toDouble == d)

  test("a shorter text would be another number"):
    val random = Random(2)
    for _ <- 0 until 2000 do
      val f = random.nextFloat()
      val short = java.math.BigDecimal(NumberText.of(f))
      val less = short.round(java.math.MathContext(short.precision - 1))
      assert(short.precision == 1 || less.floatValue != f)

  private def digits(text: String): Int = java.math.BigDecimal(text).stripTrailingZeros.precision
