package candela.bsdf.composite

import candela.bsdf.{Bsdf, Directions, Fresnel}
import candela.color.Rgb

class PrincipledSuite extends BurleySuite(PrincipledMaterial(_)):
  private def surface(
      metallic: Float = 0f,
      specularTint: Float = 0f,
      sheen: Float = 0f,
      clearcoat: Float = 0f,
      transmission: Float = 0f,
      flatness: Float = 0f
  ): Bsdf = material(
    metallic = metallic,
    specularTint = specularTint,
    anisotropic = 0.3f,
    sheen = sheen,
    clearcoat = clearcoat,
    clearcoatGloss = 0.3f,
    transmission = transmission,
    flatness = flatness
  )

  obeysLaws("plain", surface())
  obeysLaws("metal", surface(metallic = 0.7f, specularTint = 0.5f))
  // The coat of Mitsuba lacks the cosines that make others reciprocal
  obeysLaws("cloth", surface(sheen = 0.5f, flatness = 0.5f))
  obeysLaws("coated", surface(clearcoat = 0.6f))
  obeysLaws("clear", surface(transmission = 0.7f))

  test("opaque surfaces are black from behind"):
    val (wo, wi) = (Directions.at(40, 0), Directions.at(65, 130))
    assert(!surface(clearcoat = 1f).f(wo, wi).isBlack)
    assert(surface(clearcoat = 1f).f(-wo, -wi).isBlack)

  test("inside, a sample weighs what its microfacet reflects or lets through"):
    val clear = material(color = Rgb.White, transmission = 1f, roughness = 0.2f)
    val mixed = material(color = Rgb.White, transmission = 0.5f, roughness = 0.2f, clearcoat = 1f)
    for bsdf <- Seq(clear, mixed); degrees <- Seq(100, 120, 130, 150, 175) do
      val wo = Directions.at(degrees, 20)
      for i <- 0 until 64 do
        val s =
          bsdf.sample(wo, (i + 0.5f) / 64, (i * 7 % 64 + 0.5f) / 64, (i * 11 % 64 + 0.5f) / 64)
        // Refraction to the outside compresses light by the square of the index
        assert(s.weight.max <= (if s.wi.z > 0f then 2.26f else 1.001f), s"$degrees°, ${s.weight}")

  test("reflectance blends Fresnel's term, a metal of the colour and a tinted dielectric"):
    val curve = PrincipledReflectance(color, Rgb(1.5f, 1f, 0.5f), 0.3f, 0.4f, 1.5f, 0.2f)
    val weight = Math.pow(1 - 0.6, 5)
    def schlick(normal: Double) = normal + (1 - normal) * weight
    val exact = Fresnel.dielectric(0.6f, 1.5f)
    val expected =
      0.7 * 0.6 * exact + 0.3 * schlick(0.6) + 0.7 * 0.4 * schlick(1.5 * 0.04)
    assert(Math.abs(curve(0.6f).r - expected) < 1e-5)
    // From inside, only the dielectric that lets light in
    assert(Math.abs(curve(-0.9f).r - 0.2f * Fresnel.dielectric(-0.9f, 1.5f)) < 1e-6f)
