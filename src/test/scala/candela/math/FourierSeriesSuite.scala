package candela.math

import candela.testing.{ChiSquare, Draws}

import org.scalatest.funsuite.AnyFunSuite

class FourierSeriesSuite extends AnyFunSuite:
  private val series = Array(9f, 1f, 0.6f, -0.2f, 0.1f)

  test("the value is the sum of cosines, from any place in an array"):
    for phi <- Seq(0.0, 0.3, 1.2, 2.9, Math.PI) do
      val right = (1 until 5).map(k => series(k) * Math.cos((k - 1) * phi)).sum
      assert(Math.abs(FourierSeries.value(series, 1, 4, Math.cos(phi).toFloat) - right) < 1e-6)

  test("samples are spread like the series"):
    val terms = series.drop(1)
    val draws = Draws(4)
    val (bins, n) = (40, 100000)
    val seen = new Array[Long](bins)
    for _ <- 0 until n do
      val phi = FourierSeries.sample(terms, 4, draws.unit())
      seen(Math.min((phi / TwoPi * bins).toInt, bins - 1)) += 1
    def integral(phi: Double): Double =
      phi + (1 until 4).map(k => terms(k) * Math.sin(k * phi) / k).sum
    val expected = Array.tabulate(bins): i =>
      val edge = 2 * Math.PI / bins
      n * (integral((i + 1) * edge) - integral(i * edge)) / (2 * Math.PI)
    val result = ChiSquare.counts(seen, expected)
    assert(result.accepted(tests = 1), result)

  test("the ends of the interval are angles, too"):
    assert(FourierSeries.sample(Array(1f), 1, 0f) == 0f)
    assert(Math.abs(FourierSeries.sample(Array(1f), 1, 0.25f) - Pi / 2) < 1e-6f)
    assert(FourierSeries.sample(Array(1f, 1f), 2, OneMinusEpsilon) <= TwoPi)
