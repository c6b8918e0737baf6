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
        // The errors that sinCos states, also below
        assert(Math.abs(sine - Math.sin(x)) <= 4e-9, x)
        assert(Math.abs(cosine - Math.cos(x)) <= 4e-9, x)

  test("sines of tiny angles keep their relative precision"):
    for e <- 1 to 30 do
      val x = Math.pow(10, -e)
      sinCos(x): (sine, cosine) =>
        assert(Math.abs(sine / Math.sin(x) - 1) < 1e-9, x)
        assert(Math.abs(cosine - Math.cos(x)) < 4e-9, x)
