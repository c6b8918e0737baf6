package candela.measure

import org.scalatest.funsuite.AnyFunSuite

class ErrorEstimateSuite extends AnyFunSuite:
  /** From the scatters of V(n), after 16 samples. */
  private def estimate(pixels: Double)(variance: Double => Double): ErrorEstimate =
    def scatter(n: Double) = variance(n / 2) - variance(n)
    val now = scatter(16)
    ErrorEstimate(16, 2 * now, now, now, Some(scatter(8) / now), pixels)

  /** V(n) = a / n + b / n³. */
  private def mixture(a: Double, b: Double, pixels: Double = 1e20) =
    estimate(pixels)(n => a / n + b / (n * n * n))

  private def isNear(a: Double, b: Double) = Math.abs(a / b - 1) < 1e-6

  test("variance that falls as 1 / n and 1 / n³ is known exactly, also after twice the samples"):
    for (a, b) <- Vector((1.0, 0.0), (0.0, 1.0), (1.0, 30.0), (2.0, 700.0)); n <- Vector(16, 32, 64)
    do
      val errors = mixture(a, b).at(n)
      assert(isNear(errors.relativeMse, a / n + b / n / n / n))
      assert(isNear(errors.mse, 2 * errors.relativeMse))

  test("no mixture of rates in between leaves more"):
    for rate <- Vector(1.2, 1.5, 2.0, 2.5); share <- Vector(0.1, 0.5, 1.0) do
      def variance(n: Double) = share * Math.pow(n, -rate) + (1 - share) / n
      assert(estimate(100)(variance).at(16).relativeMse > variance(16))

  test("up to the next power of two samples are as if independent"):
    val smooth = mixture(0, 1)
    assert(isNear(smooth.falloff(24), 16.0 / 24) && isNear(smooth.falloff(40), 16.0 / 40 / 4))
    assert(isNear(mixture(1, 0).falloff(24), 16.0 / 24))

  test("scatters that grow, or fall faster than 1 / n³, are noise"):
    def factor(decay: Option[Double]) = ErrorEstimate(16, 1, 1, 1, decay, 100).factor
    assert(factor(Some(0.5)) == 1 && isNear(factor(Some(100)), 1 / 7.0) && factor(None) == 1)

  test("the interval holds what rates of falling and pixels allow"):
    val rough = mixture(1, 100)
    val interval = rough.interval(16)
    assert(isNear(interval.low, rough.relative / 3) && isNear(interval.high, rough.relative))
    assert(interval.low < interval.estimate && interval.estimate < interval.high)
    val smooth = mixture(0, 1, pixels = 50).interval(16)
    assert(smooth.low < smooth.estimate)
    // exp(1.96 √(4 / 3 / 50))
    val uncertain = mixture(1, 100, pixels = 50).interval(16)
    assert(Math.abs(uncertain.high / interval.high - 1.3772) < 1e-4)
    assert(Math.abs(interval.low / uncertain.low - 1.3772) < 1e-4)
    // A bright pixel may be right
    val bright = ErrorEstimate(16, 1, 1, 0.1, None, 1e20).interval(16)
    assert(isNear(bright.low, 0.1 / 3) && isNear(bright.high, 1))

  test("an error takes as many samples as its falloff says"):
    for b <- Vector(0.0, 30.0, 1e4, 1e6); target <- Vector(1e-2, 1e-3, 1e-5) do
      val rough = mixture(1, b, pixels = 500)
      val end = rough.samplesUntil(target)
      assert(rough.at(end.estimate * 1.000001).relativeMse <= target)
      assert(rough.at(end.estimate * 0.99).relativeMse > target)
      assert(end.low <= end.estimate && end.estimate <= end.high)
      // The limits of the error have it then, too
      assert(isNear(rough.interval(16).high * 16 / end.high, target))
    assert(mixture(1, 0).samplesUntil(1) == Interval(16, 16, 16))
