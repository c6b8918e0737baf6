package candela.bsdf.microfacet

import candela.bsdf.{BsdfLaws, Directions}
import candela.color.Rgb

class FresnelBlendSuite extends BsdfLaws:
  obeysLaws(
    "varnished wood",
    FresnelBlend(Rgb(0.5f, 0.3f, 0.1f), Rgb.gray(0.05f), TrowbridgeReitz(0.3f, 0.3f))
  )
  obeysLaws(
    "brushed varnish",
    FresnelBlend(Rgb.gray(0.5f), Rgb.gray(0.5f), new CosinePower(5f, 20f))
  )

  test("under a coat that reflects all, the base is black"):
    val shape = TrowbridgeReitz(0.3f, 0.3f)
    val (wo, wi) = (Directions.at(50, 0), Directions.at(20, 100))
    val white = FresnelBlend(Rgb.White, Rgb.White, shape).f(wo, wi)
    assert(white == FresnelBlend(Rgb.Black, Rgb.White, shape).f(wo, wi))

  test("the value is that of the paper"):
    val (cosO, cosI) = (Math.cos(Math.toRadians(50)), Math.cos(Math.toRadians(20)))
    val (wo, wi) = (Directions.at(50, 0), Directions.at(20, 180))
    val cosM = Math.cos(Math.toRadians(35))
    def fifth(x: Double) = Math.pow(x, 5)
    val base = 28 / (23 * Math.PI) * 0.4 * (1 - 0.1) *
      (1 - fifth(1 - cosO / 2)) * (1 - fifth(1 - cosI / 2))
    // The facet is tilted by 15°.
    val d = 22 / (2 * Math.PI) * Math.pow(Math.cos(Math.toRadians(15)), 20)
    val coat = (0.1 + 0.9 * fifth(1 - cosM)) * d / (4 * cosM * Math.max(cosO, cosI))
    val actual = FresnelBlend(Rgb.gray(0.4f), Rgb.gray(0.1f), CosinePower(20f)).f(wo, wi).r
    assert(Math.abs(actual - (base + coat)) < 1e-5 * actual) // rounding
