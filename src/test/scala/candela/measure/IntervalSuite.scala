package candela.measure

import org.scalatest.funsuite.AnyFunSuite

import java.util.SplittableRandom

class IntervalSuite extends AnyFunSuite:

  /** The chance of |t| < x by Simpson's rule over the density of Student's distribution. */
  private def inside(x: Double, degrees: Int): Double =
    def density(t: Double) = Math.pow(1 + t * t / degrees, -(degrees + 1) / 2.0)
    def integral(from: Double, to: Double): Double =
      val n = 4000
      val h = (to - from) / n
      (0 to n).map: i =>
        val weight = if i == 0 || i == n then 1 else if i % 2 == 1 then 4 else 2
        weight * density(from + i * h) * h / 3
      .sum
    // The tails of few degrees of freedom are long: t = tan makes them finite.
    def whole =
      val n = 20000
      val h = Math.PI / 2 / n
      (0 until n).map: i =>
        val a = (i + 0.5) * h
        density(Math.tan(a)) / (Math.cos(a) * Math.cos(a)) * h
      .sum
    integral(0, x) / whole

  test("95 % of Student's distribution are within the table's values, and beyond the table"):
    for degrees <- Vector(1, 2, 3, 4, 7, 12, 20, 29, 30, 31, 60, 500) do
      // The table's three digits: 5e-4, times a density of 0.12
      assert(Math.abs(inside(Interval.studentT(degrees), degrees) - 0.95) < 1e-4, degrees)

  test("the interval of a mean holds the truth in 95 of 100 cases"):
    val random = SplittableRandom(7)
    val trials = 4000
    val hits = (1 to trials).count: _ =>
      // Sums of twelve uniform numbers are about normal.
      val values = Vector.fill(5)(Vector.fill(12)(random.nextDouble()).sum)
      val i = Interval.ofMean(values)
      i.low <= 6 && 6 <= i.high
    // Three deviations of a binomial count of 4000 are 41.
    assert(Math.abs(hits - 0.95 * trials) < 41)

  test("one measurement has no interval, equal ones have an empty one"):
    val one = Interval.ofMean(Vector(3.0))
    assert(one.estimate == 3 && !one.isKnown)
    assert(Interval.ofMean(Vector(2.0, 2.0, 2.0)) == Interval(2, 2, 2))

  test("a reciprocal has the reciprocal interval, and none of its ends where there was no limit"):
    assert(Interval(2, 1, 4).inverse == Interval(0.5, 0.25, 1))
    assert(Interval(2, 1, Double.PositiveInfinity).inverse == Interval(0.5, 0, 1))

  test("the median ignores what is far off"):
    assert(Interval.median(Vector(3.0, 1000.0, 1.0)) == 3)
    assert(Interval.median(Vector(4.0, 1.0, 2.0, 3.0)) == 2.5)
