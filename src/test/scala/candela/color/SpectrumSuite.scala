package candela.color

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Colorimetry.White

final class SpectrumSuite extends AnyFunSuite:
  private val ramp = Array(400f, 500f, 700f)
  private val values = Array(1f, 3f, 2f)

  test("it goes through its points and is linear between them"):
    val s = Spectrum(ramp, values)
    for (nm, v) <- Seq(400f -> 1f, 500f -> 3f, 700f -> 2f, 450f -> 2f, 600f -> 2.5f) do
      assert(Math.abs(s(nm) - v) < 1e-6f) // rounding

  test("beyond its ends it stays, or is 0, as asked"):
    val clamped = Spectrum(ramp, values)
    val zero = Spectrum(ramp, values, Spectrum.Outside.Zero)
    assert((clamped(300f), clamped(800f)) == (1f, 2f))
    assert((zero(300f), zero(800f)) == (0f, 0f))
    assert((zero(400f), zero(700f)) == (1f, 2f))

  test("a constant is the same everywhere, an empty one is 0"):
    assert(Seq(100f, 550f, 900f).forall(Spectrum(Array(550f), Array(0.3f))(_) == 0.3f))
    assert(Spectrum(Array.empty, Array.empty)(550f) == 0f)

  test("a factor scales every value"):
    assert((Spectrum(ramp, values) * 2f)(450f) == 4f)

  test("a black body of 5800 K is brightest near 500 nm, where it is 1"):
    // Wien: 2.898e-3 m·K / 5800 K = 499.6 nm; 500 nm is a sample of the table
    val sun = Spectrum.blackbody(5800f)
    assert(Math.abs(sun(500f) - 1f) < 1e-4f)
    assert(sun(400f) < 1f && sun(700f) < 1f)

  test("a black body can be 1 at any wavelength instead, and keeps its shape"):
    val (plain, scaled) = (Spectrum.blackbody(3500f), Spectrum.blackbody(3500f, unitAt = 555f))
    assert(Math.abs(scaled(555f) - 1f) < 1e-6f)
    assert(Math.abs(scaled(700f) / scaled(450f) - plain(700f) / plain(450f)) < 1e-4f) // rounding

  test("hotter bodies are bluer"):
    def blueness(k: Float) =
      val c = Colorimetry.unitLuminance(Spectrum.blackbody(k))
      c.b / c.r
    assert(blueness(2700f) < blueness(6500f) && blueness(6500f) < blueness(20000f))

final class DaylightSuite extends AnyFunSuite:

  test("daylight of 6504 K is D65"):
    // Which was named 6500 K when Planck's constant was taken to be another
    val found = Daylight.spectrum(6500f)
    for nm <- 360 to 830 by 10 do
      // The components have one digit behind the point; 100 is the middle
      assert(Math.abs(found(nm.toFloat) - Colorimetry.D65(nm.toFloat)) < 0.2f, s"at $nm nm")

  test("the warmer the redder, also where there is no daylight"):
    val ratios = Seq(2500f, 3900f, 4500f, 6500f, 9000f, 20000f).map: kelvin =>
      val c = Colorimetry.rgb(Daylight.spectrum(kelvin), White.EqualEnergy)
      c.b / c.r
    assert(ratios.zip(ratios.tail).forall(_ < _), ratios)

  test("the spectrum has the chromaticity of its temperature"):
    for kelvin <- Seq(4500f, 9000f) do
      val c = Colorimetry.rgb(Daylight.spectrum(kelvin), White.EqualEnergy)
      val v = Colorimetry.xyzOfRgb * Vector(c.r, c.g, c.b).map(_.toDouble)
      val (x, y) = WhiteBalance.chromaticity(Daylight.correlated(kelvin))
      // CIE 15 gives the components one digit behind the point
      assert(Math.abs(v(0) / v.sum - x) < 5e-4 && Math.abs(v(1) / v.sum - y) < 5e-4)
