package candela.bsdf.subsurface

import org.scalatest.funsuite.AnyFunSuite

import candela.bsdf.Fresnel

class FresnelMomentsSuite extends AnyFunSuite:

  /** ∫ of the reflectance times μ to the `power`, by the midpoint rule. */
  private def integral(eta: Float, power: Int): Double =
    val steps = 20000
    (0 until steps).map: i =>
      val mu = (i + 0.5) / steps
      Fresnel.dielectric(mu.toFloat, 1f / eta) * Math.pow(mu, power) / steps
    .sum

  for eta <- Seq(1.1f, 1.3f, 1.33f, 1.5f, 1.8f, 2.2f) do
    test(s"the fits are right for an index of $eta, from either side"):
      // How good their authors say they are
      assert(Math.abs(FresnelMoments.first(eta) - integral(eta, 1)) < 9e-4)
      assert(Math.abs(FresnelMoments.second(eta) - integral(eta, 2)) < 1.5e-3)
      assert(Math.abs(FresnelMoments.first(1 / eta) - integral(1 / eta, 1)) < 2e-5)
      assert(Math.abs(FresnelMoments.second(1 / eta) - integral(1 / eta, 2)) < 2e-5)
      assert(Math.abs(FresnelMoments.diffuse(eta) - 2 * integral(eta, 1)) < 1.2e-2)
