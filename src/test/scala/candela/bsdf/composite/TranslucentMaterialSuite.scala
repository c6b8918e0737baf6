package candela.bsdf.composite

import candela.bsdf.{Bsdf, BsdfLaws, Directions, Hemisphere}
import candela.bsdf.microfacet.{Roughness, RoughnessModel}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.math.*
import candela.textures.{ConstantFloat, ConstantRgb, RgbTexture}

class TranslucentMaterialSuite extends BsdfLaws:
  private def gray(v: Float): RgbTexture = ConstantRgb(Rgb.gray(v))
  private def make(edition: Edition, kd: Float, ks: Float, r: Float, t: Float): Bsdf =
    val model =
      if edition == Edition.Second then RoughnessModel.BlinnExponent
      else RoughnessModel.PlainAlpha
    val roughness = Roughness(ConstantFloat(0.4f), ConstantFloat(0.4f), model)
    TranslucentMaterial(gray(kd), gray(ks), gray(r), gray(t), roughness, edition)
      .bsdf(ShadingPoint())

  for edition <- Edition.values do
    // Diffuse light passes without the square of the index that the gloss has
    val isReciprocal = edition == Edition.Second
    obeysLaws(
      s"$edition edition",
      make(edition, 0.4f, 0.5f, 0.5f, 0.5f),
      isReciprocal = isReciprocal
    )
    obeysLaws(s"$edition edition, gloss alone", make(edition, 0f, 1f, 0.3f, 0.7f))
    obeysLaws(s"$edition edition, diffuse alone", make(edition, 0.7f, 0f, 0.6f, 0.4f))

  private val (wo, wi) = (Directions.at(30, 0), Directions.at(50, 140))

  test("the diffuse part is kd·reflect/π here and kd·transmit/π beyond"):
    val sheet = make(Edition.Third, 0.5f, 0f, 0.6f, 0.2f)
    assert(abs(sheet.f(wo, wi).g - 0.3f * InvPi) < 1e-7f) // one rounding
    assert(abs(sheet.f(wo, Hemisphere.flipped(wi)).g - 0.1f * InvPi) < 1e-7f)

  test("in the second edition, gloss passes as it is reflected"):
    val sheet = make(Edition.Second, 0f, 1f, 0.5f, 0.25f)
    val (near, far) = (sheet.f(wo, wi).g, sheet.f(wo, Hemisphere.flipped(wi)).g)
    assert(near > 0f && abs(far / near - 0.5f) < 1e-6f)

  test("what neither reflects nor transmits is black"):
    assert(make(Edition.Third, 0.5f, 0.5f, 0f, 0f).f(wo, wi) == Rgb.Black)
