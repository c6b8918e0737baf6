package candela.bsdf

import candela.bsdf.microfacet.{MicrofacetReflection, TrowbridgeReitz}
import candela.color.Rgb

class TwoSidedSuite extends BsdfLaws:
  private val glossy =
    MicrofacetReflection(TrowbridgeReitz(0.3f, 0.5f), DielectricReflectance(1.5f, oriented = true))
  private val surface = TwoSided(Lambert(Rgb(0.6f, 0.4f, 0.2f)), glossy)

  obeysLaws("diffuse and glossy", surface)

  test("from behind it looks like the other from the front"):
    val (wo, wi) = (Directions.at(40, 0), Directions.at(50, 170))
    assert(surface.f(wo, wi) == Lambert(Rgb(0.6f, 0.4f, 0.2f)).f(wo, wi))
    val (below, light) = (Hemisphere.flipped(wo), Hemisphere.flipped(wi))
    assert(surface.f(below, light) == glossy.f(wo, wi))
    assert(surface.f(wo, light).isBlack)
    assert(TwoSided(OneSided(glossy), OneSided(glossy)).f(below, light) == glossy.f(wo, wi))
