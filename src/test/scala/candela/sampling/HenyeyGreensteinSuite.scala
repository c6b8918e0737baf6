package candela.sampling

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.{ChiSquare, Draws}

final class HenyeyGreensteinSuite extends AnyFunSuite:
  private val asymmetries = Seq(-0.8f, -0.3f, 0f, 0.0005f, 0.5f, 0.9f)
  private val Tests = 6

  for (g, i) <- asymmetries.zipWithIndex do
    test(s"g $g: it integrates to 1 over the sphere, and the mean cosine is g"):
      // By the substitution of the sampling itself the integrand would be trivial: cosines at equal
      // steps instead, fine enough for the peak of 0.9
      val n = 200000
      val cosines = Array.tabulate(n)(k => -1.0 + (k + 0.5) * 2.0 / n)
      val values = cosines.map(c => HenyeyGreenstein.value(c.toFloat, g).toDouble)
      val total = values.sum * 2.0 / n * 2 * Math.PI
      val mean = values.zip(cosines).map((v, c) => -v * c).sum * 2.0 / n * 2 * Math.PI
      assert(Math.abs(total - 1) < 1e-4)
      assert(Math.abs(mean - g) < 1e-3)

    test(s"g $g: samples are as dense as its values"):
      val phase = HenyeyGreenstein(g)
      val wo = Vec3.Z
      val result = ChiSquare.directions(seed = 7 + i)(
        u => Some(phase.sample(wo, u(), u())),
        wi => phase.value(wo, wi)
      )
      assert(result.accepted(Tests), result)

  test("samples are unit vectors, for all directions and up to the ends of the unit interval"):
    val draws = Draws(3)
    for g <- Seq(-0.999f, -0.99f, 0f, 0.99f, 0.999f); u <- Seq(0f, 0.5f, OneMinusEpsilon) do
      val wo = draws.direction()
      val wi = HenyeyGreenstein(g).sample(wo, u, draws.unit())
      assert(Math.abs(wi.length - 1f) < 1e-5f, s"$g $u $wi")
      assert(HenyeyGreenstein(g).value(wo, wi) > 0f)

  test("a positive g sends light ahead"):
    val phase = HenyeyGreenstein(0.5f)
    assert(phase.value(Vec3.Z, -Vec3.Z) > phase.value(Vec3.Z, Vec3.Z))
