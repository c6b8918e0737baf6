package candela.bsdf.microfacet

import candela.bsdf.{Bsdf, BsdfLaws, Directions}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{ConstantFloat, ConstantRgb}

class ShinyMetalSuite extends BsdfLaws:
  private def make(ks: Rgb, kr: Rgb): Bsdf =
    val roughness =
      Roughness(ConstantFloat(0.2f), ConstantFloat(0.2f), RoughnessModel.BlinnExponent)
    ShinyMetalMaterial(ConstantRgb(ks), ConstantRgb(kr), roughness).bsdf(ShadingPoint())

  obeysLaws("only rough", make(Rgb(0.9f, 0.6f, 0.3f), Rgb.Black))

  test("each part reflects its colour at normal incidence"):
    val colour = Rgb(0.9f, 0.6f, 0.3f)
    val off = (ShinyMetalMaterial.curve(colour)(1f) - colour).map(c => abs(c)).max
    assert(off < 1e-6f) // a few roundings
    val mirror = make(Rgb.Black, colour).sample(Vec3.Z, 0.5f, 0.5f, 0.5f)
    assert(mirror.isSpecular && (mirror.weight - colour).map(c => abs(c)).max < 1e-6f)

  test("both parts reflect at once, as in PBRT 2: a walk along mirrors sees the smooth one whole"):
    val both = make(Rgb.gray(0.9f), Rgb.gray(0.9f))
    assert(abs(both.sampleSpecular(Vec3.Z, 0.5f).weight.g - 0.9f) < 1e-6f)
    assert(both.f(Vec3.Z, Directions.at(10, 0)).g > 0f)
