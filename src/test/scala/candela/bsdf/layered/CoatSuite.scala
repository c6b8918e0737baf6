package candela.bsdf.layered

import java.util.SplittableRandom

import org.scalatest.funsuite.AnyFunSuite

import candela.bsdf.{Directions, Statistics}
import candela.bsdf.microfacet.TrowbridgeReitz
import candela.math.*

class CoatSuite extends AnyFunSuite:
  private val walks = 40000

  private def mean(sample: => Double): Statistics =
    val statistics = Statistics()
    for _ <- 0 until walks do statistics.add(sample)
    statistics

  private val roughnesses =
    Seq(0f, 0.001f, 0.03f, 0.1f, 0.3f, 1f).map(a => (a, a)) :+ (0.1f, 0.6f)

  for (ax, ay) <- roughnesses; (eta, thickness) <- Seq((1.5f, 0.01f), (1.3f, 0.5f)) do
    test(s"alpha $ax, $ay, eta $eta, thickness $thickness: passes and returns what walks do"):
      val coat = Coats().of(TrowbridgeReitz(ax, ay), eta, thickness)
      val random = SplittableRandom(7)
      val walk = LayerWalk(ax, ay, eta, thickness, 1, 10, random)
      for theta <- Seq(0.0, 40.0, 70.0, 85.0, 89.0); phi <- Seq(0.0, 50.0) do
        val w = Directions.at(theta, phi)
        val passed = mean(walk.arriving(Way(w.x, w.y, w.z)))
        // Beside chance, the 0.001 that the table is allowed.
        val actual = coat.transmittance(w)
        val off = Math.abs(actual - passed.mean)
        assert(off < 4.5 * passed.error + 1e-3, s"$actual, not $passed, at $theta°")
      val returned = mean(walk.returning())
      val off = Math.abs(coat.internalReflectance - returned.mean)
      assert(off < 4.5 * returned.error + 5e-4, s"${coat.internalReflectance}, not $returned")

  test("the mean transmittance is the mean of the transmittance"):
    for (ax, ay) <- roughnesses do
      val coat = Coats().of(TrowbridgeReitz(ax, ay), 1.5f, 0.01f)
      val integral = Directions.integrals(1, 1, fine = 256): w =>
        if w.z > 0f then coat.transmittance(w) * w.z / Math.PI else 0.0
      assert(Math.abs(coat.meanTransmittance - integral.sum) < 2e-3) // both rules' errors

  test("a smooth clear coat returns inside what reciprocity demands"):
    // 1 − R = (1 − mean outer reflectance) / eta², both by Fresnel's equations.
    for eta <- Seq(1.1f, 1.5f, 2f) do
      val coat = SmoothCoat(eta, 0f)
      // The midpoint rule.
      assert(Math.abs(1 - coat.internalReflectance - coat.meanTransmittance / (eta * eta)) < 1e-5)

  test("an index of 1 reflects nothing, only the thickness takes its share"):
    val coat = Coats().of(TrowbridgeReitz(0.3f, 0.3f), 1f, 0.2f)
    assert(coat.internalReflectance == 0f)
    val expected = Math.exp(-0.2 / Directions.at(50, 0).z)
    assert(Math.abs(coat.transmittance(Directions.at(50, 0)) - expected) < 1e-6) // rounding

  test("transmittance does not depend on the side"):
    val coat = Coats().of(TrowbridgeReitz(0.1f, 0.6f), 1.5f, 0.01f)
    for w <- Directions.few do
      assert(coat.transmittance(w) == coat.transmittance(Vec3(w.x, w.y, -w.z)))

  test("equal coats are made once"):
    val coats = Coats()
    val one = coats.of(TrowbridgeReitz(0.2f, 0.2f), 1.5f, 0.01f)
    assert(coats.of(TrowbridgeReitz(0.2f, 0.2f), 1.5f, 0.01f) eq one)
    assert(coats.of(TrowbridgeReitz(0.2f, 0.3f), 1.5f, 0.01f) ne one)

  test("between its levels, a family is off by at most 0.003"):
    val coats = Coats()
    val family = coats.family(1.5f, 0.01f)
    assert(family.length == Coats.Levels)
    for alpha <- Seq(0.01f, 0.015f, 0.045f, 0.1f, 0.36f, 0.6f, 0.99f) do
      val top = TrowbridgeReitz(alpha, alpha)
      val (near, exact) = (Coats.interpolate(family, top), coats.of(top, 1.5f, 0.01f))
      // Linear between 33 levels of roughness: the error that `Coats.interpolate` states
      assert(Math.abs(near.internalReflectance - exact.internalReflectance) < 0.003f)
      assert(Math.abs(near.meanTransmittance - exact.meanTransmittance) < 0.003f)
      for theta <- 0 to 85 by 5; w = Directions.at(theta, 0) do
        val off = Math.abs(near.transmittance(w) - exact.transmittance(w))
        assert(off < 0.003f, s"alpha $alpha at $theta°")

  test("a family takes anisotropy by its geometric mean, and ends at a roughness of 1"):
    val family = Coats().family(1.5f, 0.01f)
    val w = Directions.at(60, 20)
    assert(Coats.interpolate(family, TrowbridgeReitz(0.25f, 0.25f)).transmittance(w) ==
      family(16).transmittance(w))
    assert(Coats.interpolate(family, TrowbridgeReitz(0.0625f, 1f)).transmittance(w) ==
      family(16).transmittance(w))
    assert(Coats.interpolate(family, TrowbridgeReitz(3f, 3f)).transmittance(w) ==
      family(32).transmittance(w))
