package candela.textures

import candela.color.Rgb
import candela.geometry.ShadingPoint

import org.scalatest.funsuite.AnyFunSuite

class LinesSuite extends AnyFunSuite:
  private def at(u: Float, v: Float): ShadingPoint =
    val p = ShadingPoint()
    p.u = u
    p.v = v
    p

  test("lines lie on both sides of integers"):
    val lines = Lines(UvMapping(1f, 1f, 0f, 0f), 0.1f)
    for (u, v, isOn) <- Seq(
        (0.5f, 0.5f, false),
        (0.05f, 0.5f, true),
        (0.95f, 0.5f, true),
        (-0.05f, 0.5f, true),
        (0.5f, 2.09f, true),
        (0.5f, 2.11f, false)
      )
    do assert(lines.isOnLine(at(u, v)) == isOn, (u, v))
    val color = LinesRgb(lines, ConstantRgb(Rgb(0.5f, 0f, 0f)), ConstantRgb(Rgb(0f, 1f, 0f)))
    assert(color(at(0.5f, 0.5f)) == Rgb(0.5f, 0f, 0f) && color(at(0f, 0.5f)) == Rgb(0f, 1f, 0f))
    assert(color.maximum == Rgb(0.5f, 1f, 0f))
