package candela.bsdf.microfacet

import candela.bsdf.{BsdfLaws, Directions, Statistics}
import candela.color.Rgb
import candela.math.*

class PhongLobeSuite extends BsdfLaws:
  obeysLaws("broad", PhongLobe(Rgb.gray(0.8f), 0f))
  obeysLaws("usual", PhongLobe(Rgb(0.2f, 0.5f, 1f), 30f))
  obeysLaws("narrow", PhongLobe(Rgb.White, 10000f), isNarrow = true)

  test("the value is that of Lafortune and Willems"):
    val (wo, wi) = (Directions.at(40, 0), Directions.at(30, 160))
    val cosine = wi dot Vec3(-wo.x, -wo.y, wo.z)
    val expected = 0.5 * 32 / (2 * Math.PI) * Math.pow(cosine, 30)
    val found = PhongLobe(Rgb.gray(0.5f), 30f).f(wo, wi).g
    assert(Math.abs(found / expected - 1) < 1e-4) // the power multiplies rounding by 30

  test("at normal incidence all of the reflectance is reflected"):
    // ∫ (n + 2) / (2π) cosⁿ⁺¹ over the hemisphere is 1, without noise
    val random = java.util.SplittableRandom(1)
    val power = Statistics()
    for _ <- 0 until 100000 do
      val s = PhongLobe(Rgb.White, 5f)
        .sample(Vec3.Z, 0f, random.nextDouble().toFloat, random.nextDouble().toFloat)
      power.add(s.weight.g)
    assert(Math.abs(power.mean - 1) < 4.5 * power.error, power)

  test("narrow lobes are regularised, wide ones remain"):
    val wo = Directions.at(40, 0)
    val mirrored = Vec3(-wo.x, -wo.y, wo.z)
    def ratio(exponent: Float) =
      val lobe = PhongLobe(Rgb.White, exponent)
      lobe.regularized.f(wo, mirrored).g / lobe.f(wo, mirrored).g
    assert(ratio(1000f) < 0.1f && ratio(2f) == 1f)
