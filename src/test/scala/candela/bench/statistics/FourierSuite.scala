package candela.bench.statistics

import candela.testing.Draws

import org.scalatest.funsuite.AnyFunSuite

class FourierSuite extends AnyFunSuite:

  test("the transform is the sum of its definition, for any length and stride"):
    val draws = Draws(3)
    for n <- Vector(1, 2, 3, 4, 7, 12, 30, 49, 97, 128) do
      val re, im = Array.fill(2 * n + 1)(draws.between(-1, 1).toDouble)
      val (oldRe, oldIm) = (re.clone, im.clone)
      Fourier(n).transform(re, im, 1, 2)
      for k <- 0 until n do
        var sumRe, sumIm = 0.0
        for j <- 0 until n do
          val angle = -2 * Math.PI * j * k / n
          val (a, b) = (oldRe(1 + 2 * j), oldIm(1 + 2 * j))
          sumRe += a * Math.cos(angle) - b * Math.sin(angle)
          sumIm += a * Math.sin(angle) + b * Math.cos(angle)
        // Rounding of a sum of up to 128 numbers of about 1
        assert(Math.abs(re(1 + 2 * k) - sumRe) < 1e-11, s"$n, $k")
        assert(Math.abs(im(1 + 2 * k) - sumIm) < 1e-11, s"$n, $k"): Unit
      assert(re(0) == oldRe(0) && (n == 1 || re(2) == oldRe(2)))
