package candela.bsdf.microfacet

import candela.bsdf.{BsdfLaws, ConductorReflectance, Directions, Fresnel}
import candela.color.Rgb
import candela.math.*

class SpecularSuite extends BsdfLaws:
  obeysLaws("mirror", Mirror(Rgb.White), isLossless = true)
  obeysLaws("gold mirror", Mirror(Rgb.White, ConductorReflectance(Rgb.gray(0.2f), Rgb.gray(3f))))
  obeysLaws("glass", SmoothDielectric(1.5f), isLossless = true)
  obeysLaws("bubble", SmoothDielectric(0.7f), isLossless = true)
  obeysLaws("nothing", SmoothDielectric(1f), isLossless = true)
  obeysLaws("tinted glass", SmoothDielectric(1.5f, Rgb.gray(0.5f), Rgb(0.2f, 0.9f, 0.3f)))
  obeysLaws("mirror of glass", SmoothDielectric(1.5f, Rgb.White, Rgb.Black))
  obeysLaws(
    "glass that doesn't compress",
    SmoothDielectric(1.5f, compresses = false),
    isLossless = true,
    compresses = false
  )
  obeysLaws("pane", ThinDielectric(1.5f), isLossless = true)
  obeysLaws("half open", Passthrough(Rgb.gray(0.5f)))

  test("a mirror reflects about the normal, on both sides"):
    for wo <- Directions.few do
      val s = Mirror(Rgb.gray(0.9f)).sample(wo, 0.5f, 0.5f, 0.5f)
      assert(s.wi == Vec3(-wo.x, -wo.y, wo.z) && s.weight == Rgb.gray(0.9f) && s.pdf == 1f)

  test("glass refracts by Snell's law, says by what index, and scales radiance by its square"):
    val s = SmoothDielectric(1.5f).sample(Directions.at(30, 0), 0.999f, 0.5f, 0.5f)
    // A few roundings.
    assert(Math.abs(s.wi.x + 0.5 / 1.5) < 1e-6 && s.wi.z < 0f && s.eta == 1.5f)
    assert(Math.abs(s.weight.r - 1 / 2.25) < 1e-6)
    val back = SmoothDielectric(1.5f).sample(s.wi, 0.999f, 0.5f, 0.5f)
    assert((back.wi - Directions.at(30, 0)).length < 1e-6f && back.eta == 1 / 1.5f)
    assert(Math.abs(back.weight.r - 2.25) < 2e-6)

  test("past the critical angle glass is a mirror"):
    val s = SmoothDielectric(1.5f).sample(Directions.at(130, 0), 0.999f, 0.5f, 0.5f)
    assert(s.wi.z < 0f && s.weight == Rgb.White && s.pdf == 1f && s.eta == 1f)

  test("an index of 1 lets light straight through"):
    val wo = Directions.at(70, 20)
    val s = SmoothDielectric(1f).sample(wo, 0f, 0.5f, 0.5f)
    assert((s.wi + wo).length < 1e-6f && s.weight == Rgb.White) // rounding of the cosine

  test("a pane reflects as much as the sum of its inner reflections"):
    val r = Fresnel.dielectric(Directions.at(60, 0).z, 1.5f).toDouble
    var (sum, inside) = (r, 1 - r)
    for _ <- 0 until 100 do
      inside *= r // off the far side
      sum += inside * (1 - r)
      inside *= r // off the near side
    val wo = Directions.at(60, 0)
    val s = ThinDielectric(1.5f).sample(wo, 0f, 0.5f, 0.5f)
    assert(Math.abs(s.pdf - sum) < 1e-6) // a few roundings
    assert(ThinDielectric(1.5f).sample(wo, 0.9f, 0f, 0f).wi == -wo)
