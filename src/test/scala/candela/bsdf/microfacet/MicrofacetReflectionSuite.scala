package candela.bsdf.microfacet

import candela.bsdf.{
  BsdfLaws, ConductorReflectance, DielectricReflectance, Directions, Fresnel, FullReflectance
}
import candela.color.Rgb
import candela.math.*

class MicrofacetReflectionSuite extends BsdfLaws:
  private val copper = ConductorReflectance(Rgb(0.2f, 0.9f, 1.1f), Rgb(3.9f, 2.6f, 2.4f))

  obeysLaws("rough metal", MicrofacetReflection(TrowbridgeReitz(0.4f, 0.4f), copper))
  obeysLaws("brushed metal", MicrofacetReflection(TrowbridgeReitz(0.3f, 0.7f), FullReflectance))
  obeysLaws(
    "nearly smooth metal",
    MicrofacetReflection(TrowbridgeReitz(0.001f, 0.001f), copper),
    isNarrow = true
  )
  obeysLaws("Blinn", MicrofacetReflection(CosinePower(8f), FullReflectance))
  obeysLaws(
    "shiny Blinn",
    MicrofacetReflection(CosinePower(10000f), copper),
    isNarrow = true
  )
  obeysLaws("anisotropic powers", MicrofacetReflection(new CosinePower(3f, 12f), FullReflectance))
  obeysLaws(
    "plastic gloss",
    MicrofacetReflection(
      TrowbridgeReitz(0.3f, 0.3f),
      DielectricReflectance(1 / 1.5f),
      Rgb.gray(0.5f)
    )
  )

  test("the value at the mirror angle is F·D·G/(4 cos²)"):
    val (alpha, theta) = (0.3, Math.toRadians(40))
    val c = Math.cos(theta)
    val d = 1 / (Math.PI * alpha * alpha)
    val lambda = (Math.sqrt(1 + Math.pow(alpha * Math.tan(theta), 2)) - 1) / 2
    val f = Fresnel.conductor(c.toFloat, copper40._1, copper40._2)
    val expected = f * d / (1 + 2 * lambda) / (4 * c * c)
    val bsdf = MicrofacetReflection(TrowbridgeReitz(0.3f, 0.3f), copper)
    val actual = bsdf.f(Directions.at(40, 0), Directions.at(40, 180)).r
    assert(Math.abs(actual - expected) < 1e-5 * expected) // rounding

  private val copper40 = (0.2f, 3.9f)

  test("the light of an oriented interface depends on the side, that of any other doesn't"):
    val shape = TrowbridgeReitz(0.3f, 0.3f)
    val (wo, wi) = (Directions.at(60, 0), Directions.at(55, 170))
    val (under, back) = (Vec3(wo.x, wo.y, -wo.z), Vec3(wi.x, wi.y, -wi.z))
    val glass = MicrofacetReflection(shape, DielectricReflectance(1.5f))
    assert(glass.f(under, back).r > 3 * glass.f(wo, wi).r)
    val plain = MicrofacetReflection(shape, DielectricReflectance(1.5f, oriented = false))
    assert(plain.f(under, back) == plain.f(wo, wi))

  test("a smooth conductor is a mirror, a rough one is not"):
    assert(Conductor(TrowbridgeReitz(0f, 0f), copper).isSpecular)
    assert(!Conductor(TrowbridgeReitz(0.1f, 0.1f), copper).isSpecular)

  test("level and opposite: where rounding leaves no density, there is no value either"):
    // Found by the long counts: weights of 4e11, as the facet's normal lay beside both directions
    val draws = candela.testing.Draws(7)
    val bsdf = MicrofacetReflection(TrowbridgeReitz(0.001f, 0.001f), FullReflectance)
    var beside = 0
    for _ <- 1 to 200000 do
      val turn = draws.between(0f, 360f)
      val (o, i) = (draws.magnitude(1e-7, 1e-4), draws.magnitude(1e-7, 1e-4))
      val there = Directions.at(90, turn)
      def lifted(z: Float, sign: Float) = Vec3(sign * there.x, sign * there.y, z).normalized
      val (wo, wi) = (lifted(o, 1f), lifted(i, -1f))
      if bsdf.pdf(wo, wi) == 0f then
        beside += 1
        assert(bsdf.f(wo, wi).isBlack, s"$wo $wi"): Unit
    assert(beside > 0)
