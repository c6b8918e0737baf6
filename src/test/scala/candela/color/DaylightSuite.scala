package candela.color

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Colorimetry.White

final class DaylightSuite extends AnyFunSuite:

  test("daylight of 6504 K is D65"):
    // Which was named 6500 K when Planck's constant was taken to be another
    val found = Daylight.spectrum(6500f)
    for nm <- 360 to 830 by 10 do
      // The components have one digit behind the point; 100 is the middle
      assert(Math.abs(found(nm.toFloat) - Colorimetry.D65(nm.toFloat)) < 0.2f, s"at $nm nm")

  test("the warmer the redder, also where there is no daylight"):
    val ratios = Seq(2500f, 3900f, 4500f, 6500f, 9000f, 20000f).map: kelvin =>
      val c = Colorimetry.rgb(Daylight.spectrum(kelvin)(_), White.EqualEnergy)
      c.b / c.r
    assert(ratios.zip(ratios.tail).forall(_ < _), ratios)

  test("the spectrum has the chromaticity of its temperature"):
    for kelvin <- Seq(4500f, 9000f) do
      val c = Colorimetry.rgb(Daylight.spectrum(kelvin)(_), White.EqualEnergy)
      val v = Colorimetry.xyzOfRgb * Vector(c.r, c.g, c.b).map(_.toDouble)
      val (x, y) = WhiteBalance.chromaticity(Daylight.correlated(kelvin))
      // CIE 15 gives the components one digit behind the point
      assert(Math.abs(v(0) / v.sum - x) < 5e-4 && Math.abs(v(1) / v.sum - y) < 5e-4)
