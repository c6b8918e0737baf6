package candela.bsdf.subsurface

import candela.testing.{ChiSquare, Draws}

import org.scalatest.funsuite.AnyFunSuite

class DipoleSuite extends AnyFunSuite:
  private val media = Seq(
    ("milk", DipoleProfile(0.0024f, 3.21f, 1.3f)),
    ("without absorption", DipoleProfile(0f, 20.4f, 1.3f)),
    ("dark", DipoleProfile(0.97f, 0.07f, 1.5f))
  )

  for (name, profile) <- media do
    test(s"$name: the reflectance is the integral over the plane"):
      // Without absorption, what is farther than r goes like 1/r
      val rest = profile.reflectance * 1e-3
      assert(Math.abs(integral(profile, 0, 1e4) - profile.reflectance) < rest)

    test(s"$name: radii are sampled with the density of the profile"):
      val draws = Draws(8)
      val n = 50000
      val edges = Array(0.0, 0.05, 0.1, 0.2, 0.4, 0.7, 1, 1.5, 2, 3, 4, 6, 10, 20, 50, 1e9)
      val seen = new Array[Long](edges.length - 1)
      for _ <- 0 until n do
        val r = profile.sample(draws.unit())
        seen(edges.indexWhere(_ > r) - 1) += 1
      val parts = edges.sliding(2).map(e => integral(profile, e(0), Math.min(e(1), 1e4))).toArray
      val expected = parts.map(_ * n / parts.sum)
      val result = ChiSquare.counts(seen, expected)
      assert(result.accepted(tests = media.length), result)

  test("nothing comes out where nothing scatters"):
    for p <- Seq(DipoleProfile(1f, 0f, 1.3f), DipoleProfile(0f, 0f, 1.3f)) do
      assert(p.reflectance == 0f && p(0.1f) == 0f)

  test("the albedo that is found for a reflectance has it"):
    for r <- Seq(0.05f, 0.3f, 0.8f, 0.98f) do
      val a = DipoleProfile.albedoOf(r, 1.3f)
      // Bisection leaves 4e-6 of the albedo; at 0.98 the reflectance has a slope of 530
      assert(Math.abs(DipoleProfile(1f - a, a, 1.3f).reflectance - r) < 2e-3f)

  private def integral(profile: DipoleProfile, from: Double, to: Double): Double =
    val steps = 20000
    val (a, b) = (Math.log(from + 1e-6), Math.log(to))
    (0 until steps).map: i =>
      val r = Math.exp(a + (b - a) * (i + 0.5) / steps)
      2 * Math.PI * r * r * profile(r.toFloat) * (b - a) / steps
    .sum
