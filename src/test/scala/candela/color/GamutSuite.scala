package candela.color

import org.scalatest.funsuite.AnyFunSuite

final class GamutSuite extends AnyFunSuite:

  test("colours of the gamut are kept, also bright ones and NaN"):
    for c <- Seq(Rgb(0f, 0.5f, 1f), Rgb(7f, 0f, 0f)) do assert(Gamut.desaturate(c) eq c)
    val infinite = Gamut.desaturate(Rgb(-1f, Float.PositiveInfinity, 1f))
    assert(infinite == Rgb(0f, Float.PositiveInfinity, 1f))
    assert(Gamut.desaturate(Rgb(Float.NaN, 1f, 1f)).r.isNaN)

  test("deep colours lose saturation, neither luminance nor hue"):
    val c = Rgb(-0.2f, 0.8f, 0.3f)
    val shown = Gamut.desaturate(c)
    assert(shown.r == 0f && Math.abs(shown.luminance - c.luminance) < 1e-6f)
    // Differences of the components keep their ratio
    val (before, after) = ((c.b - c.r) / (c.g - c.r), (shown.b - shown.r) / (shown.g - shown.r))
    assert(Math.abs(before - after) < 1e-6f)

  test("without luminance there is black"):
    assert(Gamut.desaturate(Rgb(0.1f, -1f, 0.1f)) == Rgb.Black)
