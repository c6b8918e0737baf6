package candela.sampling

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.{ChiSquare, Draws}

final class WindowedDistribution2DSuite extends AnyFunSuite:
  private val (columns, rows) = (5, 3)
  private val values =
    val draws = Draws(1)
    Array.tabulate(columns * rows)(i => if i % 4 == 1 then 0f else draws.unit())
  private val distribution = WindowedDistribution2D(values, columns, rows)

  private val windows = Seq(
    (0f, 0f, 1f, 1f),
    (0.13f, 0.2f, 0.77f, 0.9f),
    (0.41f, 0.35f, 0.59f, 0.6f), // within a cell
    (0.2f, 1f / 3f, 0.6f, 1f) // on borders of cells
  )

  private def value(x: Double, y: Double): Double =
    values((y * rows).toInt * columns + (x * columns).toInt).toDouble

  test("sums over windows are those of the cells"):
    for (x0, y0, x1, y1) <- windows do
      val n = 400
      val sum = (for i <- 0 until n; j <- 0 until n
      yield value(x0 + (x1 - x0) * (i + 0.5) / n, y0 + (y1 - y0) * (j + 0.5) / n)).sum
      val expected = sum / n / n * (x1 - x0) * (y1 - y0)
      // One of 400 steps may be on the wrong side of each of a few borders
      assert(Math.abs(distribution.integral(x0, y0, x1, y1) - expected) < 5e-3)

  test("samples lie in the window, as dense as the pdf says, which integrates to 1"):
    for ((x0, y0, x1, y1), i) <- windows.zipWithIndex do
      val result = ChiSquare.square(i + 1)(
        u =>
          val p = distribution.sample(u(), u(), x0, y0, x1, y1)
          assert(p.x >= x0 && p.x <= x1 && p.y >= y0 && p.y <= y1)
          assert(Math.abs(p.z - distribution.pdf(p.x, p.y, x0, y0, x1, y1)) <= 1e-5f * p.z)
          Some(Vec3((p.x - x0) / (x1 - x0), (p.y - y0) / (y1 - y0), 0f))
        ,
        (s, t) =>
          val (x, y) = (x0 + s * (x1 - x0), y0 + t * (y1 - y0))
          distribution.pdf(x.toFloat, y.toFloat, x0, y0, x1, y1) * (x1 - x0) * (y1 - y0)
      )
      assert(result.accepted(tests = windows.size), s"window $i: $result")

  test("a window of nothing has no samples"):
    val dark = WindowedDistribution2D(Array(0f, 1f), 2, 1)
    assert(dark.sample(0.5f, 0.5f, 0f, 0f, 0.4f, 1f).z == 0f)
    assert(dark.pdf(0.2f, 0.5f, 0f, 0f, 0.4f, 1f) == 0f)
