package candela.bsdf.composite

import org.scalatest.funsuite.AnyFunSuite

import candela.bsdf.Directions
import candela.math.*
import candela.testing.{ChiSquare, RandomLaws}

class ClearcoatDistributionSuite extends AnyFunSuite with RandomLaws:
  private val shapes = Seq(0.1f, 0.4f).map(ClearcoatDistribution(_))

  private def over(g: Vec3 => Double): Double =
    Directions.integrals(1, 1, fine = 512)(m => if m.z > 0f then g(m) else 0.0).sum

  test("the projected area of all facets is that of the surface, and so is the pdf of normals"):
    for shape <- shapes do
      // The grid's error
      assert(Math.abs(over(m => shape.d(m) * m.z.toDouble) - 1) < 2e-3)
      assert(Math.abs(over(m => shape.pdf(Vec3.Z, m)) - 1) < 2e-3)

  law("normals are as dense as their pdf"): plan =>
    for (shape, k) <- shapes.zipWithIndex do
      val result = ChiSquare.directions(plan.seed(k), draws = plan.count(200000))(
        draw = u => Some(shape.sample(Vec3.Z, u(), u())),
        pdf = m => if m.z > 0f then shape.pdf(Vec3.Z, m) else 0f
      )
      assert(result.accepted(tests = 2), result): Unit
