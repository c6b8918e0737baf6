package candela.bsdf.microfacet

import candela.bsdf.{BsdfLaws, DielectricReflectance, Directions}
import candela.color.Rgb
import candela.math.*

class RoughDielectricSuite extends BsdfLaws:
  obeysLaws("frosted glass", RoughDielectric(TrowbridgeReitz(0.4f, 0.4f), 1.5f))
  obeysLaws("brushed water", RoughDielectric(TrowbridgeReitz(0.3f, 0.6f), 1.33f))
  obeysLaws("rough bubble", RoughDielectric(TrowbridgeReitz(0.5f, 0.5f), 0.7f))
  obeysLaws(
    "tinted",
    RoughDielectric(TrowbridgeReitz(0.4f, 0.4f), 1.5f, Rgb.gray(0.3f), Rgb(0.9f, 0.5f, 0.2f))
  )
  obeysLaws(
    "opaque",
    RoughDielectric(TrowbridgeReitz(0.4f, 0.4f), 1.5f, Rgb.gray(0.8f), Rgb.Black)
  )
  obeysLaws(
    "nearly smooth",
    RoughDielectric(TrowbridgeReitz(0.001f, 0.001f), 1.5f),
    isNarrow = true
  )

  test("a nearly smooth interface passes as much as a smooth one, in the same direction"):
    val wo = Directions.at(40, 30)
    val nearly = RoughDielectric(TrowbridgeReitz(0.001f, 0.001f), 1.5f)
    val rough = nearly.sample(wo, 0.999f, 0.4f, 0.3f)
    val smooth = SmoothDielectric(1.5f).sample(wo, 0.999f, 0.4f, 0.3f)
    // A facet at that draw is tilted by less than the roughness; refraction doesn't magnify it.
    assert((rough.wi - smooth.wi).length < 2e-3f)
    assert(Math.abs(rough.weight.r - smooth.weight.r) < 2e-3f)
    assert(rough.eta == smooth.eta && !rough.isSpecular)

  test("reflection is that of microfacets with the Fresnel term of the facet"):
    val shape = TrowbridgeReitz(0.4f, 0.4f)
    val whole = RoughDielectric(shape, 1.5f)
    val gloss = MicrofacetReflection(shape, DielectricReflectance(1.5f))
    for wo <- Directions.few; wi <- Directions.few if wo.z * wi.z > 0f do
      val (a, b) = (whole.f(wo, wi).r, gloss.f(wo, wi).r)
      assert(Math.abs(a - b) <= 1e-5f * b, s"$wo $wi") // rounding

  test("smooth distributions and an index of 1 make the interface smooth"):
    assert(Dielectric(TrowbridgeReitz(0f, 0f), 1.5f).isSpecular)
    assert(Dielectric(TrowbridgeReitz(0.5f, 0.5f), 1f).isSpecular)
    assert(!Dielectric(TrowbridgeReitz(0.5f, 0.5f), 1.5f).isSpecular)

  test("refraction has the sign of the index: towards the normal in glass"):
    val wo = Directions.at(60, 0)
    val glass = RoughDielectric(TrowbridgeReitz(0.05f, 0.05f), 1.5f)
    def f(theta: Double) = glass.f(wo, Directions.at(180 - theta, 180)).r
    val snell = Math.toDegrees(Math.asin(Math.sin(Math.toRadians(60)) / 1.5))
    assert(f(snell) > 10 * f(60) && f(snell) > 10 * f(10))
    assert(glass.f(wo, Vec3(0f, 0f, 0f)) == Rgb.Black)
