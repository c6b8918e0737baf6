package candela.sampling

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.ChiSquare

class Distribution1DSuite extends AnyFunSuite:
  private val values = Array(1f, 0f, 2.5f, 0.1f, 7f, 0f, 0f)
  private val d = Distribution1D(values)

  test("the density follows the values and integrates to 1"):
    val mean = values.sum / 7
    for i <- 0 until 7 do
      // two Floats below 1 are subtracted and multiplied by 7: 7 · 2⁻²⁴, rounded up
      assert(abs(d.pdf((i + 0.5f) / 7) - values(i) / mean) < 1e-6f)
    assert(Math.abs(d.integral - mean) < 1e-6)
    val integral = (0 until 7).map(i => d.pdf((i + 0.5f) / 7).toDouble / 7).sum
    assert(Math.abs(integral - 1) < 7 * MachineEpsilon) // one Float product per bin

  test("samples are as frequent as the density says"):
    val result = ChiSquare.square(1, columns = 49, rows = 1)(
      u => Some(Vec3(d.sample(u()), 0.5f, 0f)),
      (x, _) => d.pdf(x.toFloat)
    )
    assert(result.accepted(tests = 1), result)

  test("samples have a density above zero and stay below 1"):
    for n <- Seq(1, 3, 7, 1000, 4096, 10007) do
      val last = (n - 1) % 3
      val sparse = Distribution1D(Array.tabulate(n)(i => if i % 3 == last then i + 1f else 0f))
      for u <- (0 to 5000).map(_ / 5001f) :+ OneMinusEpsilon :+ Math.nextDown(OneMinusEpsilon) do
        val x = sparse.sample(u)
        assert(x >= 0f && x < 1f)
        assert(sparse.pdf(x) > 0f, s"n=$n u=$u x=$x")

  test("all-zero values count as uniform"):
    val zero = Distribution1D(new Array[Float](8))
    assert(zero.integral == 0.0)
    for i <- 0 until 64 do
      assert(zero.sample(i / 64f) == i / 64f)
      assert(zero.pdf(i / 64f) == 1f)

  test("the density is zero outside of [0, 1]"):
    assert(d.pdf(-0.1f) == 0f && d.pdf(1.1f) == 0f && d.pdf(0f) > 0f)
