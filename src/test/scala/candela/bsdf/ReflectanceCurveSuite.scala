package candela.bsdf

import candela.color.Rgb
import org.scalatest.funsuite.AnyFunSuite

class ReflectanceCurveSuite extends AnyFunSuite:

  test("a dielectric tells its inside from its outside, unless it has none"):
    val glass = DielectricReflectance(1.5f)
    assert(glass(-0.5f) == Rgb.White) // past the critical angle
    assert(glass(0.5f).r < 0.1f)
    assert(DielectricReflectance(1.5f, oriented = false)(-0.5f) == glass(0.5f))

  test("a metal of a given reflectance reflects that at normal incidence"):
    val r = Rgb(0.2f, 0.55f, 0.98f)
    val c = ConductorReflectance.ofReflectance(r)(1f)
    // k passes through Float: 1e-7, divided by what is not reflected.
    assert((c - r).map(x => Math.abs(x)).max < 1e-6f)
    assert(ConductorReflectance.ofReflectance(Rgb.White)(1f).isFinite)

  test("a table of a linear curve is that curve, and ends where the curve ends"):
    val line = TabulatedReflectance(5, c => Rgb(c, 1 - c, 0.5f))
    for c <- Seq(0f, 0.1f, 0.33f, 0.99f, 1f, -0.7f) do
      val x = Math.abs(c)
      // Two roundings.
      assert((line(c) - Rgb(x, 1 - x, 0.5f)).map(v => Math.abs(v)).max < 2e-7f)
    assert(line(1f) == Rgb(1f, 0f, 0.5f))
    assert(line(1.0000001f) == line(1f))

  test("a metal's curve is within 0.0005 of its table of 64 values"):
    val metal = ConductorReflectance(Rgb(0.2f, 0.9f, 1.1f), Rgb(3.9f, 2.6f, 2.4f))
    val table = TabulatedReflectance(64, metal.apply)
    for i <- 0 to 1000 do
      val c = i / 1000f
      assert((table(c) - metal(c)).map(x => Math.abs(x)).max < 5e-4f, s"at $c")

  test("a table is computed when it is first asked, once"):
    var count = 0
    val table = TabulatedReflectance(
      8,
      c =>
        count += 1
        Rgb.gray(c)
    )
    assert(count == 0)
    for c <- Seq(0.3f, 0.7f) do table(c): Unit
    assert(count == 8)

  test("a table needs two values at least"):
    assertThrows[IllegalArgumentException](TabulatedReflectance(1, _ => Rgb.White))
