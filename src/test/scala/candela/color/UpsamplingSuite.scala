package candela.color

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Colorimetry.White

final class UpsamplingSuite extends AnyFunSuite:
  private val steps = Seq(0.02f, 0.3f, 0.6f, 0.95f)

  private def assertSame(found: Rgb, wanted: Rgb, tolerance: Float): Unit =
    for (a, b) <- Seq(found.r -> wanted.r, found.g -> wanted.g, found.b -> wanted.b) do
      assert(Math.abs(a - b) < tolerance, s"$found, wanted $wanted")

  test("the spectrum has the colour it was made for, and lies between 0 and 1"):
    for r <- steps; g <- steps; b <- steps do
      val wanted = Rgb(r, g, b)
      val s = Upsampling.spectrum(wanted)
      // Greys are taken as constants, white to 1e-3: see ColorimetrySuite. Others are fitted closer
      assertSame(Colorimetry.rgb(s, White.D65), wanted, 1e-3f)
      for nm <- 360 to 830 by 5 do assert(s(nm.toFloat) >= 0f && s(nm.toFloat) <= 1f)

  test("black and the primaries are held to where the fit is smooth"):
    for c <- Seq(Rgb.Black, Rgb.White, Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1)) do
      // 1e-3 by the clamp, 1e-3 as above
      assertSame(Colorimetry.rgb(Upsampling.spectrum(c), White.D65), c, 2e-3f)

  test("colours that no smooth spectrum has are those at which pbrt-v4's fit ends"):
    // Coefficients of pbrt-v4's tables, over wavelengths from 0 to 1, with five digits
    val pbrt = Vector(
      ("rec2020", Rgb(0.5f, 0, 0)) -> (200.0, -124.14, 11.15),
      ("rec2020", Rgb(0, 0, 1)) -> (-437.67, 200.0, -20.82),
      ("aces2065-1", Rgb(0.8f, 0.2f, 0.1f)) -> (200.0, -118.0, 14.37),
      ("aces2065-1", Rgb(0, 0, 1)) -> (-399.2, 200.0, -24.21),
      ("aces2065-1", Rgb(0, 0.5f, 0.5f)) -> (-346.33, 200.0, -26.78)
    )
    for ((name, color), (a, b, c)) <- pbrt do
      val s = Upsampling.spectrum(color, ColorSpace.named(name).get)
      for nm <- 360 to 830 by 5 do
        val x = (nm - 360) / 470.0
        val t = (a * x + b) * x + c
        val wanted = 0.5 + t / (2 * Math.sqrt(1 + t * t))
        // Edges may be half a nanometre apart, by another rule of integration
        assert(Math.abs(s(nm.toFloat) - wanted) < 0.06, s"$name $color at $nm nm")

  test("values above 1 are scaled down and up again"):
    val wanted = Rgb(2.5f, 1.5f, 0.5f)
    // 1e-3 as above, times the scale of 5
    assertSame(Colorimetry.rgb(Upsampling.unbounded(wanted), White.D65), wanted, 5e-3f)
    assert(Upsampling.unbounded(Rgb.Black)(500f) == 0f)

  test("fits are kept for a colour in a space: others, before or between, change nothing"):
    val wide = ColorSpace.named("rec2020").get
    val colors = Vector.tabulate(20)(i => Rgb(0.9f - 0.04f * i, 0.1f + 0.03f * i, 0.3f))
    def spectrum(c: Rgb, space: ColorSpace) =
      val s = Upsampling.spectrum(c, space)
      (400 to 700 by 20).map(nm => s(nm.toFloat))
    val first = colors.map(c => (spectrum(c, ColorSpace.Srgb), spectrum(c, wide)))
    def both(c: Rgb) = (spectrum(c, ColorSpace.Srgb), spectrum(c, wide))
    assert(colors.reverse.map(both).reverse == first)
    assert(first.distinct.size == first.size && first.forall((a, b) => a != b))
    for (c, (own, _)) <- colors.zip(first) do
      val walk = Upsampling.Walk()
      walk.moveTo(Array(c.r.toDouble, c.g.toDouble, c.b.toDouble))
      assert(own == (400 to 700 by 20).map(nm => walk(nm.toFloat)))
