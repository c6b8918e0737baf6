package candela.bench.statistics

import candela.measure.Interval
import org.scalatest.funsuite.AnyFunSuite

import java.util.SplittableRandom

class StatisticsSuite extends AnyFunSuite:

  test("the interval of a mean holds the truth in 95 of 100 cases"):
    val random = SplittableRandom(7)
    val trials = 4000
    val hits = (1 to trials).count: _ =>
      // Sums of twelve uniform numbers are about normal.
      val values = Vector.fill(5)(Vector.fill(12)(random.nextDouble()).sum)
      val i = Statistics.mean(values)
      i.low <= 6 && 6 <= i.high
    // Three deviations of a binomial count of 4000 are 41.
    assert(Math.abs(hits - 0.95 * trials) < 41)

  test("one measurement has no interval, equal ones have an empty one"):
    val one = Statistics.mean(Vector(3.0))
    assert(one.estimate == 3 && !one.isKnown)
    assert(Statistics.mean(Vector(2.0, 2.0, 2.0)) == Interval(2, 2, 2))

  test("the median ignores what is far off"):
    assert(Statistics.median(Vector(3.0, 1000.0, 1.0)) == 3)
    assert(Statistics.median(Vector(4.0, 1.0, 2.0, 3.0)) == 2.5)

  test("the upper end of what was seen n times is that of Poisson's distribution"):
    for (seen, limit) <- Vector(0L -> 2.9957, 1L -> 4.7439, 10L -> 16.962, 100L -> 118.08) do
      assert(Math.abs(Statistics.countLimit(seen) / limit - 1) < 1e-4, seen)

  test("95 % of Student's distribution are within its limit"):
    // Abramowitz and Stegun, table 26.10
    for (freedom, limit) <- Vector(1 -> 12.706, 2 -> 4.303, 10 -> 2.228, 120 -> 1.980) do
      assert(Math.abs(Statistics.studentLimit(freedom) - limit) < 1e-3, freedom)
