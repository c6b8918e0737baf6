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
        assert(
          Cdf.findBin(cdf, at, u, n, bins, at) == Cdf.findBin(cdf, at, count, u),
          s"$count, $u"
        )

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
