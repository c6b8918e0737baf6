package candela.sampling

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.{ChiSquare, Draws}

class CdfSuite extends AnyFunSuite:

  test("a search between cutpoints finds the same bin, for any number of bins"):
    val draws = Draws(5)
    for count <- Seq(1, 2, 7, 8, 9, 63, 64, 100, 1000); at <- Seq(0, 3) do
      // Some without weight, at the ends, too
      val weights = Array.fill(count)(Math.max(0f, draws.between(-0.5f, 1f)))
      val cdf = new Array[Float](at + count + 1)
      val _ = Cdf.write(weights, 0, count, cdf, at)
      val n = Cdf.cutpoints(count)
      val bins = new Array[Int](at + n + 1)
      Cdf.writeCutpoints(cdf, at, count, n, bins, at)
      val edges = cdf.drop(at).filter(_ < 1f).flatMap(u => Seq(u, Math.nextUp(u)))
      for u <- edges ++ Seq.fill(200)(draws.unit()) :+ OneMinusEpsilon if u < 1f do
        assert(Cdf.find(cdf, at, u, n, bins, at) == Cdf.find(cdf, at, count, u), s"$count, $u")

class DiscreteSuite extends AnyFunSuite:

  test("picks are as frequent as their probabilities, which follow the weights"):
    val weights = Array(3f, 0f, 1f, 4f, 0f, 8f)
    val d = Discrete(weights)
    val n = 1 << 12
    val counts = new Array[Int](6)
    for i <- 0 until n do counts(d.sample(i / n.toFloat)) += 1
    // all probabilities are multiples of 1/16, so the counts are exact
    for i <- 0 until 6 do
      assert(d.probability(i) == weights(i) / 16)
      assert(counts(i) == n * weights(i) / 16)

  test("probabilities of many unequal things sum to 1"):
    val d = Discrete(Array.tabulate(100001)(i => 1f / (1 + i % 977)))
    val sum = (0 until d.size).map(i => d.probability(i).toDouble).sum
    assert(Math.abs(sum - 1) < 1e-9) // differences of neighbouring Floats are exact: they telescope

  test("things of weight zero are never picked, not even at the ends"):
    val d = Discrete(Array(0f, 0f, 1f, 0f, 1f, 0f))
    val picks = (0f +: (1 until 1000).map(_ / 1000f) :+ OneMinusEpsilon :+ 0.5f).map(d.sample).toSet
    assert(picks == Set(2, 4))

  test("all-zero weights count as equal"):
    val d = Discrete(new Array[Float](4))
    assert((0 until 4).forall(i => d.probability(i) == 0.25f))
    assert((0 until 4).map(i => d.sample(i / 4f)) == Vector(0, 1, 2, 3))

  test("what is left of the number is uniform in [0, 1)"):
    val d = Discrete(Array(1f, 2f, 5f))
    val n = 1 << 16
    val cells = new Array[Int](16)
    for i <- 0 until n do
      val u = i / n.toFloat
      val left = d.remapped(u, d.sample(u))
      assert(left >= 0f && left < 1f)
      cells((left * 16).toInt) += 1
    // u runs over an even grid, so each of 3 × 16 parts is off by one point at most
    assert(cells.forall(c => Math.abs(c - n / 16) <= 3), cells.mkString(" "))

  test("negative and infinite weights are refused"):
    for bad <- Seq(-1f, Float.NaN, Float.PositiveInfinity) do
      assertThrows[IllegalArgumentException](Discrete(Array(1f, bad)))

class Distribution1DSuite extends AnyFunSuite:
  private val values = Array(1f, 0f, 2.5f, 0.1f, 7f, 0f, 0f)
  private val d = Distribution1D(values)

  test("the density follows the values and integrates to 1"):
    val mean = values.sum / 7
    for i <- 0 until 7 do
      // two Floats below 1 are subtracted and multiplied by 7: 7 · 2⁻²⁴, rounded up
      assert(abs(d.pdf((i + 0.5f) / 7) - values(i) / mean) < 1e-6f)
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
    for i <- 0 until 64 do
      assert(zero.sample(i / 64f) == i / 64f)
      assert(zero.pdf(i / 64f) == 1f)

  test("the density is zero outside of [0, 1]"):
    assert(d.pdf(-0.1f) == 0f && d.pdf(1.1f) == 0f && d.pdf(0f) > 0f)

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
