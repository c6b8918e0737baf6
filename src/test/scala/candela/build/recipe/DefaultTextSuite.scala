package candela.build.recipe

import org.scalatest.funsuite.AnyFunSuite

import candela.color.Rgb
import candela.math.Vec3

final class DefaultTextSuite extends AnyFunSuite:

  test("numbers are the shortest decimals that read back as the same"):
    val texts = Vector(
      0f -> "0",
      -1f -> "-1",
      0.1f -> "0.1",
      1e-4f -> "0.0001",
      1e-10f -> "1e-10",
      1.5f -> "1.5",
      100000f -> "100000",
      1e6f -> "1e6",
      1e30f -> "1e30",
      1f / 3f -> "0.33333334",
      Float.PositiveInfinity -> "infinite"
    )
    for (x, text) <- texts do
      assert(DefaultText.number(x) == text)
      assert(x.isInfinite || text.toFloat == x)

  test("a grey is one number, other colours are three"):
    assert(DefaultText.color(Rgb.gray(0.5f)) == "0.5")
    assert(DefaultText.color(Rgb(1f, 0.5f, 0f)) == "1 0.5 0")
    assert(DefaultText.triple(Vec3(1f, 0f, -2f)) == "1 0 -2")
