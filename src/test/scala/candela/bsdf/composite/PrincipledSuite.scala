package candela.bsdf.composite

import candela.bsdf.{Bsdf, BsdfLaws, Directions, Fresnel}
import candela.color.Rgb
import candela.geometry.ShadingPoint
import candela.textures.{ConstantFloat, ConstantRgb}

class PrincipledSuite extends BsdfLaws:
  private val color = Rgb(0.6f, 0.4f, 0.2f)

  private def material(
      metallic: Float = 0f,
      tint: Float = 0f,
      sheen: Float = 0f,
      coat: Float = 0f,
      transmission: Float = 0f,
      flatness: Float = 0f
  ): Bsdf =
    def constant(x: Float) = ConstantFloat(x)
    PrincipledMaterial(
      DisneyParameters(
        ConstantRgb(color),
        constant(metallic),
        constant(1.5f),
        constant(0.6f),
        constant(tint),
        constant(0.3f),
        constant(sheen),
        constant(0.5f),
        constant(coat),
        constant(0.3f),
        constant(transmission),
        isThin = false,
        constant(flatness),
        constant(0f)
      )
    ).bsdf(ShadingPoint())

  obeysLaws("plain", material())
  obeysLaws("metal", material(metallic = 0.7f, tint = 0.5f))
  // The coat of Mitsuba lacks the cosines that make others reciprocal
  obeysLaws("cloth", material(sheen = 0.5f, flatness = 0.5f))
  obeysLaws("coated", material(coat = 0.6f))
  obeysLaws("clear", material(transmission = 0.7f))

  test("opaque surfaces are black from behind"):
    val (wo, wi) = (Directions.at(40, 0), Directions.at(65, 130))
    assert(!material(coat = 1f).f(wo, wi).isBlack)
    assert(material(coat = 1f).f(-wo, -wi).isBlack)

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
