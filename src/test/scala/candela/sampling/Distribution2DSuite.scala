package candela.sampling

import candela.io.CheckedFile
import org.scalatest.funsuite.AnyFunSuite
import candela.math.*
import candela.testing.{ChiSquare, TempFolder}

class Distribution2DSuite extends AnyFunSuite:
  // 5 columns, 4 rows, one row and some cells empty
  private val values = Array[Float](
    1, 2, 0, 4, 1, //
    0, 0, 0, 0, 0, //
    9, 0, 0.5f, 1, 3, //
    0, 0, 0, 2, 0
  )
  private val d = Distribution2D(values, 5, 4)

  test("the density follows the values: x along columns, y down the rows"):
    val mean = values.sum / 20
    for row <- 0 until 4; column <- 0 until 5 do
      val expected = values(row * 5 + column) / mean
      // products of two differences of Floats below 1, times 20
      assert(abs(d.pdf((column + 0.5f) / 5, (row + 0.5f) / 4) - expected) < 4e-6f)
    assert(Math.abs(d.integral - mean) < 1e-6)

  test("samples are as frequent as the density says"):
    val result = ChiSquare.square(1)(
      u => Some(d.sample(u(), u())),
      (x, y) => d.pdf(x.toFloat, y.toFloat)
    )
    assert(result.accepted(tests = 1), result)

  test("a sample carries the density of its place, which is above zero, and stays below 1"):
    val big = Distribution2D(Array.tabulate(317 * 211)(i => (i * 7919L % 5).toFloat), 317, 211)
    for i <- 0 to 300; j <- 0 to 300 do
      val s = big.sample(Math.min(i / 300f, OneMinusEpsilon), Math.min(j / 300f, OneMinusEpsilon))
      assert(s.x >= 0f && s.x < 1f && s.y >= 0f && s.y < 1f)
      assert(s.z > 0f && s.z == big.pdf(s.x, s.y), s"$s")

  test("evenly spread numbers meet each of many columns as often as its weight says"):
    val weights = Array.tabulate(200)(i => (i % 7).toFloat)
    val wide = Distribution2D(weights, 200, 1)
    val counts = new Array[Int](200)
    val n = 60000
    for k <- 0 until n do
      counts((wide.sample((k + 0.5f) / n, 0.5f).x * 200).toInt) += 1
    for i <- 0 until 200 do
      val expected = n * weights(i) / weights.sum
      // Each border between columns moves by one number at most
      assert(abs(counts(i) - expected) <= 2f, s"column $i: ${counts(i)} of $n, not $expected")

  test("the density integrates to 1"):
    val n = 97
    val many = Distribution2D(Array.tabulate(n * n)(i => 1f + (i * 31L % 1009).toFloat), n, n)
    val sum = (for i <- 0 until n; j <- 0 until n
    yield many.pdf((i + 0.5f) / n, (j + 0.5f) / n).toDouble).sum
    assert(Math.abs(sum / (n * n) - 1) < 1e-6) // one Float rounding per product

  test("all-zero values count as uniform"):
    val zero = Distribution2D(new Array[Float](6), 3, 2)
    assert(zero.integral == 0.0)
    val s = zero.sample(0.4f, 0.7f)
    // a bin's edges are rounded to Float
    assert(abs(s.x - 0.4f) < 1e-6f && abs(s.y - 0.7f) < 1e-6f && abs(s.z - 1f) < 1e-6f)

  test("values near the largest Float don't overflow"):
    val huge = Distribution2D(Array.fill(12)(3e38f), 4, 3)
    assert(Math.abs(huge.integral / 3e38 - 1) < 1e-6)
    assert(abs(huge.pdf(0.5f, 0.5f) - 1f) < 1e-6f)

  test("a file of it gives the same samples; parts that don't fit together are refused"):
    TempFolder.use: folder =>
      val many = Distribution2D(Array.tabulate(61 * 40)(i => (i * 31L % 1009).toFloat), 61, 40)
      val file = folder.resolve("d")
      CheckedFile.write(file, "")(Distribution2D.Form.write(many, _))
      val again = CheckedFile.read(file, "")(Distribution2D.Form.read)
      assert(again.integral == many.integral && again.columns == 61 && again.rows == 40)
      for i <- 0 to 60; j <- 0 to 60 do
        val (u, v) = (i / 61f, j / 61f)
        assert(again.sample(u, v) == many.sample(u, v) && again.pdf(u, v) == many.pdf(u, v))
      CheckedFile.write(file, ""): out =>
        out.int(61)
        out.int(41)
        out.double(1)
        for _ <- 0 until 2 do out.floats(new Array(62 * 40))
        for _ <- 0 until 2 do out.ints(new Array(8 * 40))
      assertThrows[java.io.IOException](CheckedFile.read(file, "")(Distribution2D.Form.read))
