package candela.film

import org.scalatest.funsuite.AnyFunSuite

import candela.color.{ColorSpace, Rgb, WhiteBalance}

final class DevelopmentSuite extends AnyFunSuite:

  private def developed(c: Rgb, development: Development): Vector[Float] =
    val film = Film(PixelBounds(0, 0, 1, 1))
    film.add(0, 0, c.r, c.g, c.b, 2f)
    development(film).data.toVector

  test("values are scaled"):
    assert(developed(Rgb(1f, 2f, -3f), Development(2f)) == Vector(2f, 4f, -6f))

  test("values below 0 become 0 where they are clipped"):
    assert(developed(Rgb(1f, 2f, -3f), Development(clipsNegative = true)) == Vector(1f, 2f, 0f))

  test("a balance maps colours, after the scale"):
    val swap = Array(0f, 1f, 0f, 1f, 0f, 0f, 0f, 0f, 2f)
    assert(developed(Rgb(1f, 2f, 3f), Development(2f, balance = Some(swap))) == Vector(4f, 2f, 12f))

  test("balanced for daylight of 6500 K, sRGB's white stays; for warm light it becomes blue"):
    val near = developed(Rgb.White, Development(balance = Some(WhiteBalance.ofDaylight(6500f))))
    // Daylight of nominally 6500 K differs from D65 in the fourth digit
    assert(near.forall(v => Math.abs(v - 1f) < 2e-3f), near)
    val cold = developed(Rgb.White, Development(balance = Some(WhiteBalance.ofDaylight(4500f))))
    assert(cold(2) > 1.2f && cold(0) < 1f)

  test("balanced for a space's own white, that stays white there"):
    val aces = ColorSpace.named("aces2065-1").get
    val white = aces.light(Rgb.White)
    val balanced =
      developed(
        white,
        Development(balance = Some(WhiteBalance.ofDaylight(6000f, aces)), space = aces)
      )
    // Daylight of nominally 6000 K differs from ACES' white in the fourth digit
    assert(balanced.forall(v => Math.abs(v - 1f) < 2e-3f), balanced)

  test("the luminance of pbrt-v3 is limited, and colours keep their hue"):
    val limit = SampleLimit.luminance(1f).get
    assert(limit.scale(Rgb(1f, 1f, 1f)) == 1f)
    assert(Math.abs(limit.scale(Rgb(0f, 2f, 0f)) - 1 / (2 * 0.71516f)) < 1e-5f)
    // A blue of 10 has a luminance of 0.72
    assert(limit.scale(Rgb(0f, 0f, 10f)) == 1f)

  test("pbrt-v4's sensor limits X, Y and Z"):
    val limit = SampleLimit.sensor(1f).get
    // White has Z = 1.0888
    assert(Math.abs(limit.scale(Rgb.White) - 1 / 1.088754f) < 1e-5f)
    assert(limit.scale(Rgb(0.9f, 0.9f, 0.9f)) == 1f)

  test("no limit is no object"):
    assert(SampleLimit.luminance(Float.PositiveInfinity).isEmpty)
    assert(SampleLimit.sensor(Float.PositiveInfinity).isEmpty)
