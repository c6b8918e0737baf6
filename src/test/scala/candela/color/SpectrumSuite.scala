package candela.color

import org.scalatest.funsuite.AnyFunSuite

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
    assert(Seq(100f, 550f, 900f).forall(Spectrum.constant(0.3f)(_) == 0.3f))
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
      val c = Colorimetry.unitLuminance(Spectrum.blackbody(k)(_))
      c.b / c.r
    assert(blueness(2700f) < blueness(6500f) && blueness(6500f) < blueness(20000f))
