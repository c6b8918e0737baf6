package candela.bsdf

import candela.bsdf.microfacet.{MicrofacetReflection, SmoothDielectric, TrowbridgeReitz}
import candela.color.Rgb

class ScaledSuite extends BsdfLaws:
  private val half = Rgb(0.5f, 0.4f, 0.3f)
  private val mirror = MicrofacetReflection(TrowbridgeReitz(0.4f, 0.4f), FullReflectance)
  obeysLaws("a scaled gloss", Scaled(mirror, half))
  obeysLaws("scaled glass", Scaled(SmoothDielectric(1.5f), half))
  obeysLaws("a gloss sent through", SentThrough(mirror))

  test("sending through swaps the sides and nothing else"):
    val (wo, wi) = (Directions.at(30, 0), Directions.at(50, 140))
    assert(SentThrough(mirror).f(wo, Hemisphere.flipped(wi)) == mirror.f(wo, wi))
    assert(SentThrough(mirror).f(wo, wi) == Rgb.Black)
