package candela.math

import org.scalatest.funsuite.AnyFunSuite

class AnglesSuite extends AnyFunSuite:
  private val Steps = 100000

  test("sines and cosines of up to an eighth of a turn are those of the JVM"):
    for i <- -Steps to Steps do
      val x = i.toDouble / Steps * Math.PI / 4
      assert(Math.abs(sinOfEighth(x) - Math.sin(x)) <= 5e-12 * Math.abs(Math.sin(x)), x)
      assert(Math.abs(cosOfEighth(x) - Math.cos(x)) <= 5e-11, x)

  test("sines and cosines of a whole turn are those of the JVM"):
    for i <- 0 to Steps do
      val x = i.toDouble / Steps * 2.0 * Math.PI
      sinCos(x): (sine, cosine) =>
        assert(Math.abs(sine - Math.sin(x)) <= 4e-9, x)
        assert(Math.abs(cosine - Math.cos(x)) <= 4e-9, x)

  test("sines of tiny angles keep their relative precision"):
    for e <- 1 to 30 do
      val x = Math.pow(10, -e)
      sinCos(x): (sine, cosine) =>
        assert(Math.abs(sine / Math.sin(x) - 1) < 1e-9, x)
        assert(Math.abs(cosine - Math.cos(x)) < 4e-9, x)

  test("angles of vectors are those of the JVM"):
    for i <- 0 to Steps; length <- Vector(1e-150, 1.0, 1e150) do
      val angle = i * 2 * Math.PI / Steps
      assertAngle(length * Math.cos(angle), length * Math.sin(angle))

  test("small angles of vectors keep their relative precision"):
    for e <- 1 to 300 do
      val angle = angleOf(2.0, Math.pow(10, -e))
      assert(Math.abs(angle / Math.atan2(Math.pow(10, -e), 2.0) - 1) < 4e-12, e)

  test("angles of vectors along the axes and the diagonals"):
    for x <- -1 to 1; y <- -1 to 1 do assertAngle(x, y)
    assert(angleOf(0, 0) == 0.0)
    assert(angleOf(Double.NaN, 1).isNaN && angleOf(1, Double.NaN).isNaN)

  private def assertAngle(x: Double, y: Double) =
    // Nearly a whole turn is as good as nearly none
    val error = Math.abs(Math.IEEEremainder(angleOf(x, y) - Math.atan2(y, x), 2 * Math.PI))
    assert(error <= 1e-11, (x, y))
