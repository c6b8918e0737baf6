package candela.bsdf.composite

import candela.bsdf.Directions
import candela.math.*
import candela.testing.{ChiSquare, RandomLaws}

class ClearcoatDistributionSuite extends RandomLaws:
  private val shapes = Seq(0.1f, 0.4f).map(ClearcoatDistribution(_))

  test("the projected area of all facets is that of the surface, and so is the pdf of normals"):
    for shape <- shapes do
      // The grid's error
      assert(Math.abs(Directions.overHemisphere(m => shape.d(m) * m.z.toDouble) - 1) < 2e-3)
      assert(Math.abs(Directions.overHemisphere(m => shape.pdf(Vec3.Z, m)) - 1) < 2e-3)

  law("normals are as dense as their pdf"): plan =>
    for (shape, k) <- shapes.zipWithIndex do
      val result = ChiSquare.directions(plan.seed(k), draws = plan.count(200000))(
        draw = u => Some(shape.sample(Vec3.Z, u(), u())),
        pdf = m => if m.z > 0f then shape.pdf(Vec3.Z, m) else 0f
      )
      assert(result.accepted(tests = 2), result): Unit
