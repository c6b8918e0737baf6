package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint
import org.scalatest.funsuite.AnyFunSuite

class CombinedSuite extends AnyFunSuite:

  private def at(u: Float, v: Float): ShadingPoint =
    val point = ShadingPoint()
    point.u = u
    point.v = v
    point

  private val uv = UvMapping(1f, 1f, 0f, 0f)
  private val ramp: FloatTexture = BilerpFloat(uv, 0f, 0f, 1f, 1f)
  private val rgbRamp: RgbTexture = BilerpRgb(uv, Rgb.Black, Rgb(0f, 2f, 0f), Rgb.White, Rgb.White)
  private def number(x: Float): FloatTexture = ConstantFloat(x)
  private def gray(x: Float): RgbTexture = ConstantRgb(Rgb.gray(x))

  test("what follows from constants alone becomes a constant"):
    assert(ScaledFloat.of(number(2f), number(3f)).constant.contains(6f))
    assert(ProductRgb.of(gray(2f), gray(3f)).constant.contains(Rgb.gray(6f)))
    assert(ScaledRgb.of(gray(2f), number(3f)).constant.contains(Rgb.gray(6f)))
    assert(MixFloat.of(number(2f), number(4f), number(0.25f)).constant.contains(2.5f))
    assert(MixRgb.of(gray(2f), gray(4f), number(0.25f)).constant.contains(Rgb.gray(2.5f)))

  test("factors of 1 and mixes of one texture alone disappear"):
    assert(ScaledFloat.of(ramp, number(1f)) eq ramp)
    assert(ScaledFloat.of(number(1f), ramp) eq ramp)
    assert(ProductRgb.of(rgbRamp, gray(1f)) eq rgbRamp)
    assert(ProductRgb.of(gray(1f), rgbRamp) eq rgbRamp)
    assert(ScaledRgb.of(rgbRamp, number(1f)) eq rgbRamp)
    assert(MixFloat.of(ramp, number(3f), number(0f)) eq ramp)
    assert(MixRgb.of(gray(3f), rgbRamp, number(1f)) eq rgbRamp)

  test("the rest is worked out at the point"):
    val p = at(0.25f, 0f)
    assert(ScaledFloat.of(ramp, number(2f))(p) == 0.5f)
    assert(ProductRgb.of(rgbRamp, rgbRamp)(p) == Rgb.gray(0.0625f))
    assert(ScaledRgb.of(gray(2f), ramp)(p) == Rgb.gray(0.5f))
    assert(MixFloat.of(number(4f), number(8f), ramp)(p) == 5f)
    assert(MixRgb.of(gray(4f), gray(8f), ramp)(p) == Rgb.gray(5f))
    assert(ScaledFloat.of(ramp, ramp).constant.isEmpty)

  test("bilerp meets its corners: v10 at s = 1, v01 at t = 1"):
    val numbers = BilerpFloat(uv, 1f, 2f, 3f, 4f)
    assert(numbers(at(0f, 0f)) == 1f && numbers(at(0f, 1f)) == 2f)
    assert(numbers(at(1f, 0f)) == 3f && numbers(at(1f, 1f)) == 4f)
    assert(numbers(at(0.5f, 0.5f)) == 2.5f)
    assert(rgbRamp(at(0f, 1f)) == Rgb(0f, 2f, 0f))
    assert(rgbRamp(at(0.5f, 0.5f)) == Rgb(0.5f, 1f, 0.5f))
