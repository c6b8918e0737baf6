package candela.bsdf.layered

import candela.bsdf.{Bsdf, BsdfLaws, DiffuseTransmission, Directions, Fresnel, Lambert}
import candela.bsdf.microfacet.{
  Beckmann, FresnelBlend, MicrofacetDistribution, Mirror, SeparableTrowbridgeReitz, TrowbridgeReitz
}
import candela.color.Rgb
import candela.math.*

class CoatedSuite extends BsdfLaws:
  private val Eta = 1.5f
  private val smooth = TrowbridgeReitz(0f, 0f)
  private val rough = Beckmann(0.3f, 0.3f)

  private def coated(
      inner: Bsdf,
      top: MicrofacetDistribution,
      absorption: Rgb = Rgb.Black,
      gloss: Rgb = Rgb.White
  ): Bsdf =
    val coat = if top.isSmooth then SmoothCoat(Eta, 0f) else RoughCoat(top, Eta, 0f)
    Coated(inner, top, coat, absorption, gloss)

  private val glossy =
    FresnelBlend(Rgb.gray(0.4f), Rgb.gray(0.2f), SeparableTrowbridgeReitz(0.3f, 0.4f))
  obeysLaws("smooth over diffuse", coated(Lambert(Rgb(0.3f, 0.6f, 0.9f)), smooth))
  obeysLaws("rough over diffuse", coated(Lambert(Rgb(0.3f, 0.6f, 0.9f)), rough))
  obeysLaws("smooth over glossy", coated(glossy, smooth, Rgb(0.1f, 0.5f, 2f)))
  obeysLaws("rough over glossy", coated(glossy, rough, Rgb(0.1f, 0.5f, 2f), Rgb.gray(0.5f)))
  obeysLaws("smooth over a mirror", coated(Mirror(Rgb.gray(0.9f)), smooth))
  obeysLaws(
    "over a sheet",
    coated(DiffuseTransmission(Rgb.gray(0.3f), Rgb.gray(0.5f)), smooth)
  )

  private val (wo, wi) = (Directions.at(40, 0), Directions.at(65, 130))
  private def passes(w: Vec3) = 1.0 - Fresnel.dielectric(w.z, Eta)
  private def within(w: Vec3) = Math.sqrt(1 - (1 - w.z * w.z) / (Eta * Eta))

  test("the base is seen through both passages, and absorbed along the refracted ways"):
    val base = coated(Lambert(Rgb.gray(0.5f)), smooth, Rgb(0f, 0.7f, 0f)).f(wo, wi)
    val clear = 0.5 / Math.PI * passes(wo) * passes(wi) / (Eta * Eta)
    val dimmed = clear * Math.exp(-0.7 * (1 / within(wo) + 1 / within(wi)))
    assert(Math.abs(base.r / clear - 1) < 1e-4 && Math.abs(base.g / dimmed - 1) < 1e-4)

  test("a rough coat of little roughness is a smooth one"):
    def base(top: MicrofacetDistribution) =
      coated(Lambert(Rgb.White), top, gloss = Rgb.Black).f(wo, wi).g
    // The table of what a rough coat lets pass is good to 0.001
    assert(Math.abs(base(Beckmann(0.01f, 0.01f)) / base(smooth) - 1) < 3e-3)

  test("a mirror under a smooth coat sends back what passes twice"):
    val s = coated(Mirror(Rgb.White), smooth).sample(wo, 0.9f, 0.5f, 0.5f)
    assert(s.isSpecular && Math.abs(s.wi.z - wo.z) < 1e-6f && Math.abs(s.wi.x + wo.x) < 1e-6f)
    val chance = s.pdf
    assert(Math.abs(s.weight.g * chance - passes(wo) * passes(wo)) < 1e-4)
