package candela.color

import org.scalatest.funsuite.AnyFunSuite

final class ColorSpaceSuite extends AnyFunSuite:
  private def named(name: String) = ColorSpace.named(name).get

  private def assertNear(found: Matrix3, digits: Double)(wanted: Double*): Unit =
    for i <- 0 until 9 do
      assert(
        Math.abs(found(i / 3, i % 3) - wanted(i)) <= digits,
        s"number $i: ${found(i / 3, i % 3)}"
      )

  test("BT.2020 becomes BT.709 by the published matrix"):
    // ITU-R BT.2407-0, §2.2; the white of sRGB's matrix differs in the fourth digit
    assertNear(named("rec2020").toSrgb, 5e-4)(
      1.6605, -0.5876, -0.0728, -0.1246, 1.1329, -0.0083, -0.0182, -0.1006, 1.1187
    )

  test("ACES2065-1 becomes XYZ by the published matrix"):
    // SMPTE ST 2065-1:2012, equation 1
    assertNear(named("aces2065-1").xyzOfRgb, 1e-9)(
      0.9525523959, 0.0, 0.0000936786, 0.3439664498, 0.7281660966, -0.0721325464, 0.0, 0.0,
      1.0088251844
    )

  test("a space and sRGB convert to each other"):
    val c = Rgb(0.3f, 1.5f, -0.2f)
    for space <- ColorSpace.all do
      val again = space.light(space.ofSrgb * c)
      // Digits of sRGB's published matrices
      assert((again - c).map(Math.abs).max < 1e-5f, s"$space: $again")

  test("white light keeps the colour of its space, white reflectance is white"):
    for space <- ColorSpace.all do
      assert(space.reflectance(Rgb.White) == Rgb.White)
      val adapted = space.toSrgbAdapted * Rgb.White
      assert((adapted - Rgb.White).map(Math.abs).max < 1e-5f, s"$space: $adapted")
    val aces = named("aces2065-1").light(Rgb.White)
    assert(aces.r > 1.04f && aces.b < 0.92f && Math.abs(aces.luminance - 1f) < 1e-5f)

  test("a reflectance keeps its spectrum: under the white of ACES it has its colour"):
    val aces = named("aces2065-1")
    val c = Rgb(0.4f, 0.35f, 0.3f)
    val s = Upsampling.spectrum(c, aces)
    val xyz =
      aces.illuminantXyz.map(row => Vector(row(1), row(2), row(3)).map(_ * s(row(0).toFloat)))
    val found = aces.rgbOfXyz * xyz.reduce((a, b) => a.zip(b).map(_ + _))
    for (a, b) <- found.zip(Seq(c.r, c.g, c.b)) do assert(Math.abs(a - b) < 1e-5)
    val srgb = aces.reflectance(c)
    // Bradford's adaptation knows no spectra: half a percent was seen
    val adapted = aces.toSrgbAdapted * c
    assert((srgb - adapted).map(Math.abs).max < 0.01f * srgb.max, s"$srgb, $adapted")
    assert((srgb - aces.light(c)).map(Math.abs).max > 0.01f)

  test("primaries are recognised; others make a space of their own, unless they are none"):
    val p3 = Primaries((0.68, 0.32), (0.265, 0.69), (0.15, 0.06), (0.31271, 0.32902))
    assert(ColorSpace.of(p3).contains(named("dci-p3")))
    // ACEScg: SMPTE ST 2065-4's AP1, as wide as BT.2020, with the white of ACES
    val ap1 = Primaries((0.713, 0.293), (0.165, 0.830), (0.128, 0.044), (0.32168, 0.33767))
    val acescg = ColorSpace.of(ap1).get
    assert(acescg.illuminant eq named("aces2065-1").illuminant)
    assertNear(acescg.ofSrgbAdapted, 5e-4)(
      0.6131, 0.3395, 0.0474, 0.0702, 0.9164, 0.0134, 0.0206, 0.1096, 0.8698
    )
    val line = Primaries((0.1, 0.1), (0.2, 0.2), (0.3, 0.3), (0.3127, 0.3290))
    assert(ColorSpace.of(line).isEmpty)
    assert(ColorSpace.of(p3.copy(white = (Double.NaN, 0.0))).isEmpty)
