package candela.measure

import org.scalatest.funsuite.AnyFunSuite

import java.util.SplittableRandom

class IntervalSuite extends AnyFunSuite:

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
