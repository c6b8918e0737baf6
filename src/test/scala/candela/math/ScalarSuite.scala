package candela.math

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.testing.Draws

class ScalarSuite extends AnyFunSuite:

  test("a difference of products is the exact one, rounded once", Slow):
    val draws = Draws(1)
    for i <- 0 until 100000 do
      val a = draws.between(-2, 2) * draws.magnitude(1e-6, 1e6)
      val b = draws.between(-2, 2)
      // every other time the products all but cancel
      val c = if i % 2 == 0 then draws.between(-2, 2) else Math.nextUp(a)
      val d = if i % 2 == 0 then draws.between(-2, 2) else b
      def exact(x: Float) = BigDecimal(x.toDouble, java.math.MathContext.UNLIMITED)
      val truth = exact(a) * exact(b) - exact(c) * exact(d)
      // The class claims 1.5 ulp
      val off = (exact(differenceOfProducts(a, b, c, d)) - truth).abs
      assert(off <= BigDecimal(1.5 * Math.ulp(truth.toFloat).toDouble), s"${a}·$b − ${c}·$d")

  test("a difference of equal products is zero, where rounding would leave rubbish"):
    val x = 1.1f
    assert(differenceOfProducts(x, 3.3f, 3.3f, x) == 0f)
    // (x + ε)(x − ε) − x² = −ε², which is lost when the products are rounded
    val eps = 1.0f / 4096
    assert(differenceOfProducts(1 + eps, 1 - eps, 1f, 1f) == -eps * eps)

  test("gamma bounds the error of a row of rounded operations"):
    val draws = Draws(2)
    for _ <- 0 until 10000 do
      val factors = Seq.fill(9)(draws.between(0.5f, 2))
      val rounded = factors.reduce(_ * _)
      val exact = factors.map(_.toDouble).reduce(_ * _)
      assert(Math.abs(rounded / exact - 1) <= gamma(8)) // nine factors, eight products

  test("safeSqrt of what rounding left below zero is zero; lerp meets both ends"):
    assert(safeSqrt(-1e-7f) == 0f && safeSqrt(4f) == 2f)
    assert(lerp(0f, 3f, 7f) == 3f && lerp(1f, 3f, 7f) == 7f)
    assert(clamp(-1f, 0f, 2f) == 0f && clamp(3f, 0f, 2f) == 2f && clamp(1f, 0f, 2f) == 1f)
