package candela.bsdf

import candela.color.Rgb

class OrenNayarSuite extends BsdfLaws:
  obeysLaws("clay", OrenNayar(Rgb.gray(0.8f), 20f))
  obeysLaws("moon", OrenNayar(Rgb.White, 90f))

  test("without roughness it is Lambertian"):
    val wo = Directions.at(50, 10)
    for wi <- Directions.few if wi.z > 0 do
      val f = OrenNayar(Rgb.gray(0.7f), 0f).f(wo, wi)
      assert(f == Lambert(Rgb.gray(0.7f)).f(wo, wi))

  test("the value is that of the paper, worked out from angles"):
    val sigma = Math.toRadians(30)
    val a = 1 - sigma * sigma / (2 * (sigma * sigma + 0.33))
    val b = 0.45 * sigma * sigma / (sigma * sigma + 0.09)
    for (thetaO, thetaI, phi) <- Seq((20.0, 60.0, 40.0), (75.0, 30.0, 10.0), (50.0, 50.0, 150.0)) do
      val alpha = Math.toRadians(Math.max(thetaO, thetaI))
      val beta = Math.toRadians(Math.min(thetaO, thetaI))
      val azimuths = Math.max(0.0, Math.cos(Math.toRadians(phi)))
      val expected = 0.5 / Math.PI * (a + b * azimuths * Math.sin(alpha) * Math.tan(beta))
      val f = OrenNayar(Rgb.gray(0.5f), 30f).f(Directions.at(thetaO, 0), Directions.at(thetaI, phi))
      // Ten roundings.
      assert(Math.abs(f.r - expected) < 1e-6 * expected)

  test("seen against the light, a rough sphere's rim stays brighter than a Lambertian one"):
    val rim = Directions.at(80, 0)
    assert(OrenNayar(Rgb.White, 40f).f(rim, rim).r > 1.2f * Lambert(Rgb.White).f(rim, rim).r)
