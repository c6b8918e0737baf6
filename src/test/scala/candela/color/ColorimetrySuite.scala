package candela.color

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Colorimetry.White

final class ColorimetrySuite extends AnyFunSuite:

  test("a perfect reflector under D65 is white"):
    val c = Colorimetry.rgb(_ => 1f, White.D65)
    // sRGB's matrix is published to six digits, D65's table in steps of 5 nm
    for v <- Seq(c.r, c.g, c.b) do assert(Math.abs(v - 1f) < 1e-3f, c)

  test("under equal energy it is reddish, and its luminance is 1"):
    val c = Colorimetry.rgb(_ => 1f, White.EqualEnergy)
    assert(c.r > c.g && c.r > c.b)
    assert(Math.abs(c.luminance - 1f) < 1e-3f) // the matrix's digits

  test("colours are linear in the spectrum"):
    val s = NamedSpectra("metal-Cu-k").get
    val (one, three) =
      (Colorimetry.rgb(s, White.D65), Colorimetry.rgb(s * 3f, White.D65))
    assert(Math.abs(three.r - 3 * one.r) < 1e-4f * one.r) // rounding

  test("narrow bands count as much as is in them, wherever they lie between the samples"):
    val y = Colorimetry.observers(1)
    for first <- 540 to 560 by 3 do
      val band = Spectrum(
        Array(first - 1f, first.toFloat, first + 6f, first + 7f),
        Array(0f, 1f, 1f, 0f),
        Spectrum.Outside.Zero
      )
      val exact = (10 * first - 10 to 10 * first + 70).map(x => band(x / 10f) * y(x / 10f)).sum / 10
      val found = Colorimetry.rgb(band, White.EqualEnergy).luminance * 106.8569f
      assert(Math.abs(found / exact - 1) < 5e-4, s"at $first nm: $found, not $exact")

  test("emission is scaled to luminance 1"):
    val c = Colorimetry.unitLuminance(Spectrum.blackbody(3000f))
    assert(Math.abs(c.luminance - 1f) < 1e-5f) // rounding
    assert(c.r > c.g && c.g > c.b)

  test("copper is red, gold yellow, silver grey"):
    def metal(name: String): Rgb =
      val eta = NamedSpectra(s"metal-$name-eta").get
      val k = NamedSpectra(s"metal-$name-k").get
      // Normal incidence: ((η − 1)² + k²) / ((η + 1)² + k²)
      def r(nm: Float) =
        val (n, kk) = (eta(nm), k(nm) * k(nm))
        ((n - 1) * (n - 1) + kk) / ((n + 1) * (n + 1) + kk)
      Colorimetry.rgb(r, White.D65)
    val (cu, au, ag) = (metal("Cu"), metal("Au"), metal("Ag"))
    assert(cu.r > cu.g && cu.g > cu.b)
    assert(au.r > au.g && au.g > 2 * au.b)
    // Silver's least and greatest channel differ by a few percent
    assert(ag.b > 0.85f && ag.r / ag.b < 1.1f)
