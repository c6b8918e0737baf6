package candela.cli.rendering

import org.scalatest.funsuite.AnyFunSuite

import candela.measure.Interval

class SummarySuite extends AnyFunSuite:
  private def squares(estimate: Double, low: Double, high: Double) =
    Some(Interval(estimate * estimate, low * low, high * high))

  test("an error that is known to 15 % has no interval"):
    assert(Summary.noise(16, Some(0.02), squares(0.02, 0.0175, 0.0225)) == "error 2 %")
    assert(Summary.noise(16, Some(0.02), None) == "error 2 %")

  test("an error that may be further off has one"):
    val below = Summary.noise(16, Some(0.046), squares(0.046, 0.0331, 0.0523))
    assert(below == "error 4.6 % (3.31 to 5.23 %)")
    val above = Summary.noise(16, Some(0.02), squares(0.02, 0.0199, 0.03))
    assert(above == "error 2 % (1.99 to 3 %)")
