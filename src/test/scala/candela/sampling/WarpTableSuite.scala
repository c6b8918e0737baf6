package candela.sampling

import java.util.SplittableRandom

import candela.math.*
import org.scalatest.funsuite.AnyFunSuite

class WarpTableSuite extends AnyFunSuite:
  private val (width, height) = (5, 4)
  private val random = SplittableRandom(1)
  private val data = Array.fill(2 * 3 * width * height)(0.2f + random.nextDouble().toFloat)
  private val first = Array(-1f, 1f)
  private val second = Array(0f, 0.5f, 2f)
  private val table = WarpTable(width, height, data, first, second, isDensity = true)
  private def unit() = Math.min(random.nextDouble().toFloat, OneMinusEpsilon)

  test("values are those of the grid at its points, and means between them"):
    val plain = WarpTable(width, height, data, first, second)
    val at = plain.Blend(-1f, 0.5f)
    val start = width * height
    assert(Math.abs(at(0.25f, 1f / 3) - data(start + width + 1)) < 1e-5f) // rounding
    assert(Math.abs(at(1f, 1f) - data(2 * start - 1)) < 1e-5f)
    val between = plain.Blend(0f, 0.25f)(0f, 0f)
    val corners = Seq(0, 1, 3, 4).map(k => data(k * start))
    assert(Math.abs(between - corners.sum / 4) < 1e-5f)
    assert(plain.Blend(-9f, 9f)(0f, 0f) == data(2 * start))

  test("several functions share a grid"):
    val two = WarpTable(2, 2, Array(1f, 2f, 3f, 4f, 10f, 20f, 30f, 40f), Array(0f), Array(0f), 2)
    val at = two.Blend(0f, 0f)
    assert(at(1f, 0f) == 2f && at(1f, 0f, 1) == 20f && Math.abs(at(0.5f, 0.5f, 1) - 25f) < 1e-5f)

  test("every density integrates to one"):
    for (a, b) <- Seq((-1f, 0f), (0.3f, 0.2f), (1f, 2f)) do
      val at = table.Blend(a, b)
      val n = 240
      val sum =
        (for i <- 0 until n; j <- 0 until n
        yield at((i + 0.5f) / n, (j + 0.5f) / n).toDouble).sum / (n * n)
      assert(Math.abs(sum - 1) < 1e-4, s"$a $b") // the grid

  test("what is drawn is found again by the inverse"):
    for _ <- 0 until 2000 do
      val at = table.Blend(2 * unit() - 1, 2 * unit())
      val (u1, u2) = (unit(), unit())
      at.sample(u1, u2)
      at.invert(at.x, at.y)
      // Sums are Floats
      assert(Math.abs(at.x - u1) < 1e-4f && Math.abs(at.y - u2) < 1e-4f)

  test("points are drawn by the density"):
    val at = table.Blend(0.4f, 1f)
    val n = 100000
    val seen = new Array[Double](16)
    for k <- 0 until n do
      at.sample((k + 0.5f) / n, (Integer.reverse(k) >>> 8) * 5.9604645e-8f)
      seen(Math.min((at.y * 4).toInt, 3) * 4 + Math.min((at.x * 4).toInt, 3)) += 1.0 / n
    for i <- 0 until 16 do
      val m = 40
      val expected =
        (for j <- 0 until m; k <- 0 until m
        yield at(
          (i % 4 + (j + 0.5f) / m) / 4,
          (i / 4 + (k + 0.5f) / m) / 4
        ).toDouble).sum / (m * m * 16)
      assert(Math.abs(seen(i) - expected) < 1e-3, s"part $i") // evenly spread points
