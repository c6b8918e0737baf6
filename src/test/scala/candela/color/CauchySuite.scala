package candela.color

import org.scalatest.funsuite.AnyFunSuite

class CauchySuite extends AnyFunSuite:

  test("the spread of the index between the lines F and C is that of the Abbe number"):
    for abbe <- Seq(20.0, 55.0) do
      val n = Cauchy(1.6f, (20 / abbe).toFloat)
      // Interpolation between wavelengths 10 nm apart
      assert(Math.abs(n(587.56f) - 1.6f) < 1e-4f)
      val spread = n(486.13f) - n(656.27f)
      assert(Math.abs(0.6 / spread - abbe) < 0.01 * abbe)

  test("no index is below 1, and without dispersion there is one"):
    assert(Cauchy(1.05f, 40f).values.min == 1f)
    assert(Cauchy(1.6f, 0f).values.toVector == Vector(1.6f))
