package candela.bsdf.composite

import candela.bsdf.{
  Bsdf, BsdfLaws, DiffuseMaterial, DiffuseTransmissionMaterial, Directions, InterfaceMaterial,
  Material
}
import candela.bsdf.microfacet.{DielectricMaterial, Roughness, RoughnessModel}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{ConstantFloat, ConstantRgb, RgbTexture}

class MixedMaterialSuite extends BsdfLaws:
  private val at = ShadingPoint()
  private val red = Rgb(0.7f, 0.1f, 0.1f)
  private val paper = DiffuseMaterial(ConstantRgb(red))
  private val sheet = DiffuseTransmissionMaterial(gray(0.3f), gray(0.5f), 1f)
  private val gloss = PlasticMaterial(
    gray(0.2f),
    gray(0.5f),
    Roughness(ConstantFloat(0.3f), ConstantFloat(0.3f), RoughnessModel.PlainAlpha),
    Edition.Third
  )
  private val glass = DielectricMaterial(
    1.5f,
    Roughness(ConstantFloat(0f), ConstantFloat(0f), RoughnessModel.PlainAlpha)
  )

  private def gray(v: Float): RgbTexture = ConstantRgb(Rgb.gray(v))
  private def mix(a: Material, b: Material, amount: Rgb): Bsdf =
    MixedMaterial(a, b, ConstantRgb(amount)).bsdf(at)

  obeysLaws("paper and gloss", mix(paper, gloss, Rgb(0.25f, 0.5f, 0.75f)))
  obeysLaws("a sheet and glass", mix(sheet, glass, Rgb.gray(0.5f)))
  obeysLaws("paper and nothing", mix(paper, InterfaceMaterial, Rgb.gray(0.3f)))

  private val (wo, wi) = (Directions.at(30, 0), Directions.at(50, 140))

  test("each colour is blended by its own amount"):
    val amount = Rgb(0.25f, 0.5f, 0.75f)
    val (a, b) = (paper.bsdf(at).f(wo, wi), gloss.bsdf(at).f(wo, wi))
    val expected = a * amount + b * (Rgb.White - amount)
    val off = (mix(paper, gloss, amount).f(wo, wi) - expected).map(c => abs(c)).max
    assert(off < 1e-6f) // a few roundings of values below 1

  test("all of one is that one, and amounts beyond are held"):
    for amount <- Seq(1f, 1.5f) do
      assert(mix(paper, gloss, Rgb.gray(amount)).f(wo, wi) == paper.bsdf(at).f(wo, wi))
    assert(mix(paper, gloss, Rgb.gray(-1f)).f(wo, wi) == gloss.bsdf(at).f(wo, wi))

  test("the mirrors in a mixture are found by a walk along mirrors"):
    val found = mix(paper, glass, Rgb.gray(0.5f)).sampleSpecular(wo, 0.9f)
    assert(found.isSpecular && !found.weight.isBlack)

  test("a mixture of constants is made once"):
    assert(MixedMaterial(paper, gloss, gray(0.5f)).isConstant)

  test("parts that are chosen point by point are the blend, on average"):
    val inner = MixedMaterial(gloss, paper, gray(0.3f))
    val blend = MixedMaterial(inner, sheet, ConstantRgb(Rgb(0.25f, 0.5f, 0.75f)))
    val chosen = ChosenMaterial(blend)
    assert(!chosen.isConstant)
    val count = 20000
    val point = ShadingPoint()
    val sum = (0 until count).foldLeft(Rgb.Black): (sum, i) =>
      point.p = Vec3(i * 1e-4f, 0f, 1f)
      sum + chosen.bsdf(point).f(wo, wi)
    val expected = blend.bsdf(at).f(wo, wi)
    // Values differ by a factor of 10 at most: four standard deviations
    val off = (sum * (1f / count) - expected).map(c => abs(c)).max
    assert(off < 0.04f * expected.max, s"$off of $expected")
