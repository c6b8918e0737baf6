package candela.measure

import org.scalatest.funsuite.AnyFunSuite

class LogLogFitSuite extends AnyFunSuite:
  private val hyperbola = Vector(1.0, 2.0, 8.0, 64.0).map(x => (x, 3 / x))

  test("the slope of a power is its exponent"):
    assert(Math.abs(LogLogFit.slope(hyperbola).get + 1) < 1e-12)
    val root = Vector(1.0, 3.0, 10.0).map(x => (x, 5 / Math.sqrt(x)))
    assert(Math.abs(LogLogFit.slope(root).get + 0.5) < 1e-12)

  test("there is no slope through one place, and points without logarithm don't count"):
    assert(LogLogFit.slope(Vector((1.0, 2.0), (1.0, 3.0))).isEmpty)
    assert(LogLogFit.slope(Vector((1.0, 2.0), (2.0, 0.0))).isEmpty)

  test("the curve is followed between its points, and not beyond"):
    assert(Math.abs(LogLogFit.firstAt(hyperbola, 3 / 16.0).get - 16) < 1e-9)
    assert(Math.abs(LogLogFit.firstAt(hyperbola, 3 / 64.0).get - 64) < 1e-9)
    assert(LogLogFit.firstAt(hyperbola, 0.01).isEmpty)
    assert(LogLogFit.firstAt(hyperbola, 4.0).contains(1.0))
