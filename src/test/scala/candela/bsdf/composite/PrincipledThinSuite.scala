package candela.bsdf.composite

import candela.bsdf.{Bsdf, Directions, Fresnel}

class PrincipledThinSuite extends BurleySuite(PrincipledThinMaterial(_)):
  private def surface(
      clear: Float = 0f,
      passing: Float = 0f,
      sheen: Float = 0f,
      specularTint: Float = 0f,
      flatness: Float = 0f
  ): Bsdf = material(
    transmission = clear,
    diffTrans = 2f * passing,
    isThin = true,
    anisotropic = 0.3f,
    sheen = sheen,
    specularTint = specularTint,
    flatness = flatness
  )

  obeysLaws("paper", surface(passing = 0.4f, flatness = 0.5f))
  obeysLaws("cloth", surface(passing = 0.2f, sheen = 0.5f))
  // Whether a microfacet is between two directions depends on which is the viewer's
  obeysLaws("clear", surface(clear = 0.7f, specularTint = 0.5f), isReciprocal = false)

  test("a sheet is the same from both sides"):
    val thin = surface(clear = 0.4f, passing = 0.3f, specularTint = 0.5f)
    for wi <- Seq(Directions.at(65, 130), Directions.at(150, 20)) do
      val wo = Directions.at(40, 0)
      assert((thin.f(wo, wi) - thin.f(-wo, -wi)).max < 1e-5f && !thin.f(wo, wi).isBlack)

  test("diffuse light is divided between reflection and transmission"):
    val (wo, wi) = (Directions.at(0, 0), Directions.at(60, 0))
    val thin = surface(passing = 0.3f)
    assert(Math.abs(thin.f(wo, -wi).r - 0.3 * 0.6 / Math.PI) < 1e-5)
    assert(Math.abs(thin.f(wo, wi).r / surface().f(wo, wi).r - 0.7f) < 1e-5f)

  test("tint blends Fresnel's term with Schlick's, also from behind"):
    val curve = ThinReflectance(color, 0.4f, 1.5f)
    val schlick = 0.6 * 0.04 + (1 - 0.6 * 0.04) * Math.pow(1 - 0.6, 5)
    val expected = 0.6 * Fresnel.dielectric(0.6f, 1.5f) + 0.4 * schlick
    assert(Math.abs(curve(0.6f).r - expected) < 1e-5)
    assert(curve(-0.6f).r == curve(0.6f).r)
