package candela.color

import org.scalatest.funsuite.AnyFunSuite

class SrgbSuite extends AnyFunSuite:

  test("published points of the curve are met"):
    // IEC 61966-2-1's own worked constants, to the digits it prints.
    assert(Srgb.decode(0f) == 0f)
    assert(Srgb.decode(1f) == 1f)
    assert(Math.abs(Srgb.decode(0.5f) - 0.21404114f) < 1e-7f)
    assert(Math.abs(Srgb.encode(0.18f) - 0.46135613f) < 1e-7f)

  test("decode undoes encode, below 0 and above 1 too"):
    for i <- -100 to 1200 do
      val linear = i / 1000f
      // Eight roundings of Float around the power; slope at most 12.92.
      assert(Math.abs(Srgb.decode(Srgb.encode(linear)) - linear) < 1e-6f, s"at $linear")

  test("the two pieces meet within the precision of the standard's constants"):
    assert(Math.abs(Srgb.encode(0.0031308f) - Srgb.encode(Math.nextUp(0.0031308f))) < 1e-6f)

  test("each of the 256 codes survives decoding and encoding"):
    for code <- 0 to 255 do
      assert(Srgb.encode8(Srgb.decode(code / 255f)) == code)

  test("8-bit codes clamp, and NaN is black"):
    assert(Srgb.encode8(-1f) == 0)
    assert(Srgb.encode8(Float.NegativeInfinity) == 0)
    assert(Srgb.encode8(Float.NaN) == 0)
    assert(Srgb.encode8(2f) == 255)
    assert(Srgb.encode8(Float.PositiveInfinity) == 255)

  test("encodings decode by their curve"):
    assert(Encoding.Linear.decode(-3f) == -3f)
    assert(Encoding.Srgb.decode(0.5f) == Srgb.decode(0.5f))
    assert(Encoding.Gamma(2f).decode(0.5f) == 0.25f)
    assert(Encoding.Gamma(2.2f).decode(-0.5f) == 0f)
