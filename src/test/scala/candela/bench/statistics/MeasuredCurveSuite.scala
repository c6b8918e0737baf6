package candela.bench.statistics

import candela.measure.{Errors, LogLogFit, Metric}
import org.scalatest.funsuite.AnyFunSuite

class MeasuredCurveSuite extends AnyFunSuite:

  /** Error `c / samples`, with a factor for each seed; two samples a second after one second. */
  private def measurement(samples: Int, seed: Int, factor: Double) =
    val error = factor * 0.8 / samples
    val errors = Errors(error, error, None, None, None, Vector(1.0, 1.0 + 0.01 * seed, 1.0))
    Measurement(samples, seed, 1 + samples / 2.0, errors)

  private val factors = Vector(0.9, 1.0, 1.1)
  private val all =
    for samples <- Vector(16, 1, 4); (f, seed) <- factors.zipWithIndex
    yield measurement(samples, seed + 1, f)
  private val curve = MeasuredCurve(all, all.groupMap(_.samples)(_.seconds))

  test("points are means over the seeds, in the order of their samples"):
    assert(curve.points.map(_.samples) == Vector(1, 4, 16))
    val i = curve.points(1)(Metric.RelativeMse).get
    assert(Math.abs(i.estimate - 0.2) < 1e-12)
    // t(2) · deviation / √3
    assert(Math.abs(i.high - i.estimate - 4.3026527299 * 0.02 / Math.sqrt(3)) < 1e-9)
    assert(curve.points.head(Metric.Flip).isEmpty)

  test("a disturbed run changes the error bar of nothing, and the median little"):
    val times = all.groupMap(_.samples)(_.seconds).updated(4, Vector(3.0, 100.0, 3.0))
    assert(MeasuredCurve(all, times).points(1).seconds == 3)

  test("slope, efficiency and time to an error follow their definitions"):
    assert(Math.abs(curve.slope.get.estimate + 1) < 1e-12)
    val efficiency = curve.efficiency.get
    assert(Math.abs(efficiency.estimate - 1 / (0.05 * 9)) < 1e-9)
    assert(efficiency.low < efficiency.estimate && efficiency.estimate < efficiency.high)
    // Half-way in the logarithms between 0.8 at 1.5 s and 0.2 at 3 s
    assert(Math.abs(curve.secondsUntil(0.4).get.estimate - Math.sqrt(1.5 * 3)) < 1e-9)
    assert(curve.secondsUntil(0.01).isEmpty)
    assert(Math.abs(curve.errorAt(Math.sqrt(1.5 * 3)).get - 0.4) < 1e-9)
    assert(curve.span.contains((1.5, 9.0)))
    assert(Math.abs(curve.lowestError - 0.05) < 1e-12)
    assert(Math.abs(curve.meanRatio(1) - 1.02) < 1e-12)

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
    assert(Math.abs(LogLogFit.at(hyperbola, 16).get - 3 / 16.0) < 1e-9)
    assert(LogLogFit.at(hyperbola, 1).contains(3.0) && LogLogFit.at(hyperbola, 0.9).isEmpty)
    assert(LogLogFit.at(hyperbola, 65).isEmpty)
