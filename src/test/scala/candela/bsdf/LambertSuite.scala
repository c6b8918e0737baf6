package candela.bsdf

import candela.color.Rgb
import candela.math.*

class LambertSuite extends BsdfLaws:
  obeysLaws("white", Lambert(Rgb.White), isLossless = true)
  obeysLaws("coloured", Lambert(Rgb(0.2f, 0.5f, 0.9f)))
  obeysLaws("black", Lambert(Rgb.Black))

  test("the value is albedo over π on the near side, nothing on the far side"):
    val f = Lambert(Rgb.gray(0.5f)).f(Directions.at(20, 0), Directions.at(70, 130))
    // One rounding.
    assert(Math.abs(f.r - 0.5 / Math.PI) < 1e-7)
    assert(Lambert(Rgb.White).f(Vec3.Z, -Vec3.Z) == Rgb.Black)
