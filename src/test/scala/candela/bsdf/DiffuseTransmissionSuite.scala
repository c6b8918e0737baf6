package candela.bsdf

import candela.color.Rgb
import candela.math.*

class DiffuseTransmissionSuite extends BsdfLaws:
  obeysLaws("paper", DiffuseTransmission(Rgb.gray(0.6f), Rgb.gray(0.4f)), isLossless = true)
  obeysLaws("leaf", DiffuseTransmission(Rgb(0.1f, 0.3f, 0.1f), Rgb(0.05f, 0.5f, 0.05f)))
  obeysLaws("opaque", DiffuseTransmission(Rgb.gray(0.6f), Rgb.Black))
  obeysLaws("only transmits", DiffuseTransmission(Rgb.Black, Rgb.gray(0.7f)))

  test("each side has its own reflectance over π"):
    val leaf = DiffuseTransmission(Rgb.gray(0.3f), Rgb.gray(0.5f))
    val wo = Directions.at(40, 10)
    // One rounding.
    assert(Math.abs(leaf.f(wo, Vec3.Z).g - 0.3 / Math.PI) < 1e-7)
    assert(Math.abs(leaf.f(wo, -Vec3.Z).g - 0.5 / Math.PI) < 1e-7)

  test("what transmits nothing is not transmissive"):
    assert(!DiffuseTransmission(Rgb.White, Rgb.Black).isTransmissive)
    assert(DiffuseTransmission(Rgb.Black, Rgb.White).isTransmissive)
