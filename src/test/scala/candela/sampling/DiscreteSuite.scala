package candela.sampling

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*

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
    assert(d.total == 16.0)

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
