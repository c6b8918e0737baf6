package candela.measure

import org.scalatest.funsuite.AnyFunSuite

class ErrorEstimateSuite extends AnyFunSuite:
  /** From the scatter of V(n), after 16 samples. */
  private def estimate(pixels: Double = 1e20)(variance: Double => Double): ErrorEstimate =
    val scatter = variance(8) - variance(16)
    ErrorEstimate(16, 2 * scatter, scatter, scatter, pixels)

  private def isNear(a: Double, b: Double) = Math.abs(a / b - 1) < 1e-6

  test("variance that falls as 1 / n is known exactly, also after more samples"):
    for n <- Vector(16, 20, 64) do
      val errors = estimate()(1 / _).at(n)
      assert(isNear(errors.relativeMse, 1.0 / n) && isNear(errors.mse, 2.0 / n))

  test("variance that falls faster is estimated too high, but not above the interval"):
    for rate <- Vector(1.2, 1.5, 2.0); share <- Vector(0.1, 0.5, 1.0) do
      def variance(n: Double) = share * Math.pow(n, -rate) + (1 - share) / n
      val rough = estimate()(variance)
      val interval = rough.interval(16)
      assert(rough.at(16).relativeMse > variance(16))
      assert(interval.low < variance(16) * (1 + 1e-9) && variance(16) < interval.high)

  test("the interval holds what rates of falling and pixels allow"):
    val interval = estimate()(1 / _).interval(16)
    assert(isNear(interval.low, 1 / 16.0 / 3) && isNear(interval.high, 1 / 16.0))
    // exp(1.96 √(4 / 3 / 50))
    val uncertain = estimate(pixels = 50)(1 / _).interval(16)
    assert(uncertain.low < uncertain.estimate && uncertain.estimate < uncertain.high)
    assert(Math.abs(uncertain.high / interval.high - 1.3772) < 1e-4)
    assert(Math.abs(interval.low / uncertain.low - 1.3772) < 1e-4)
    // A bright pixel may be right
    val bright = ErrorEstimate(16, 1, 1, 0.1, 1e20).interval(16)
    assert(isNear(bright.low, 0.1 / 3) && isNear(bright.high, 1))

  test("an error takes as many samples as independent samples need"):
    for target <- Vector(1e-2, 1e-3, 1e-5) do
      val rough = estimate(pixels = 500)(1 / _)
      val end = rough.samplesUntil(target)
      assert(isNear(rough.at(end.estimate).relativeMse, target))
      assert(end.low <= end.estimate && end.estimate <= end.high)
      // The limits of the error have it then, too
      assert(isNear(rough.interval(16).high * 16 / end.high, target))
    assert(estimate()(1 / _).samplesUntil(1) == Interval(16, 16, 16))
