package candela.measure

import org.scalatest.funsuite.AnyFunSuite

class IntervalSuite extends AnyFunSuite:

  test("a reciprocal has the reciprocal interval, and none of its ends where there was no limit"):
    assert(Interval(2, 1, 4).inverse == Interval(0.5, 0.25, 1))
    assert(Interval(2, 1, Double.PositiveInfinity).inverse == Interval(0.5, 0, 1))
