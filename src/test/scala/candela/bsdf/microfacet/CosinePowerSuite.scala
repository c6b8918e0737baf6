package candela.bsdf.microfacet

import java.util.SplittableRandom

import org.scalatest.funsuite.AnyFunSuite

import candela.bsdf.Directions
import candela.math.*
import candela.testing.ChiSquare

class CosinePowerSuite extends AnyFunSuite:
  private val shapes = Seq(CosinePower(10f), new CosinePower(4f, 30f), CosinePower(0f))

  test("the projected area of all facets is that of the surface, and the pdf integrates to 1"):
    for shape <- shapes do
      // The grid's error.
      assert(Math.abs(Directions.overHemisphere(m => shape.d(m) * m.z.toDouble) - 1) < 1e-3)
      assert(Math.abs(Directions.overHemisphere(m => shape.pdf(Vec3.Z, m)) - 1) < 1e-3)

  test("sampled normals are spread like the pdf"):
    val (rows, columns, samples) = (16, 32, 60000)
    val random = SplittableRandom(10)
    for shape <- shapes do
      val seen = new Array[Long](rows * columns)
      for _ <- 0 until samples do
        val m = shape.sample(Vec3.Z, random.nextFloat(), random.nextFloat())
        seen(Directions.cell(rows, columns)(m)) += 1
      val expected = Directions.integrals(rows, columns, fine = 16)(m =>
        if m.z > 0f then shape.pdf(Vec3.Z, m).toDouble else 0.0
      )
      val result = ChiSquare.counts(seen, expected.map(_ * samples))
      assert(result.accepted(tests = shapes.length), result)

  test("Blinn's density is (e + 2)/2π · cosᵉ"):
    val c = Math.cos(Math.toRadians(25))
    val expected = 22 / (2 * Math.PI) * Math.pow(c, 20)
    // Twenty times the rounding of the direction.
    assert(Math.abs(CosinePower(20f).d(Directions.at(25, 77)) - expected) < 3e-6 * expected)

  test("grooves hide what Torrance and Sparrow say"):
    val (wo, wi) = (Directions.at(70, 0), Directions.at(20, 0))
    val m = (wo + wi).normalized
    val g = Math.min(1, 2 * m.z * wo.z / (wo dot m))
    val expected = g / (4 * wo.z * wi.z)
    val actual = CosinePower(20f).visibility(wo, wi, m)
    assert(Math.abs(actual - expected) < 1e-6 * expected) // rounding

  test("exponents end at 10000, and no roughness at all has that one"):
    val m = Directions.at(0.5, 0)
    assert(CosinePower(Float.PositiveInfinity).d(m) == CosinePower(10000f).d(m))
    assert(CosinePower(Float.NaN).d(m) == CosinePower(10000f).d(m))
    assert(CosinePower(20000f).d(m) == CosinePower(10000f).d(m))
