package candela.color

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

final class FitStartsSuite extends AnyFunSuite:
  private val random = java.util.Random(3)
  private def unit() = random.nextFloat
  private def inside() = 1e-3f + 0.998f * unit()

  test("the table that ships is the one that the fit makes", Slow):
    val shipped = getClass.getResourceAsStream(FitStarts.Resource).readAllBytes()
    assert(java.util.Arrays.equals(shipped, FitStarts.resourceBytes))

  /** Largest difference of two spectra. */
  private def apart(a: Upsampling.Fit, b: Upsampling.Fit): Double =
    def s(f: Upsampling.Fit, x: Double) =
      val t = (f.coefficients(0) * x + f.coefficients(1)) * x + f.coefficients(2)
      0.5 + t / (2 * Math.sqrt(1 + t * t))
    (0 to 94).map(i => Math.abs(s(a, i / 94.0) - s(b, i / 94.0))).max

  for space <- ColorSpace.all do
    test(s"a fit of $space that starts from the table ends where the way from grey does"):
      val colors = Vector.fill(1000)(Rgb(inside(), inside(), inside()))
      val pairs =
        for c <- colors yield (c, Upsampling.fromTable(c, space), Upsampling.fromGrey(c, space))
      for case (c, Some(fit), far) <- pairs do
        assert(far.isExact && apart(fit, far) < 1e-6, s"$c")
      val found = pairs.count(_._2.isDefined)
      val exact = pairs.count(_._3.isExact)
      info(s"$exact of ${colors.size} have a spectrum, $found from the table")
      assert(found > 0.99 * exact)
