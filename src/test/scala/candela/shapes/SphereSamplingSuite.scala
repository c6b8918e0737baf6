package candela.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.{Draws, Soups}

class SphereSamplingSuite extends AnyFunSuite:
  private val centre = Vec3(0.3f, -0.2f, 0.1f)
  private val sphere = Soups.sphere(Transform.translate(0.3f, -0.2f, 0.1f), 0.5f)
  private val distances = Seq(1.001f, 1.1f, 3f, 99f, 101f, 1e4f) // in radii

  private def away(distance: Float, draws: Draws): Vec3 =
    centre + draws.direction() * (0.5f * distance)

  private def square(x: Double): Double = x * x

  private def oneMinusCos(from: Vec3): Double =
    def part(a: Float, b: Float) = (a.toDouble - b) * (a.toDouble - b)
    val sin2 =
      0.25 / (part(from.x, centre.x) + part(from.y, centre.y) + part(from.z, centre.z))
    2 * square(Math.sin(Math.asin(Math.sqrt(sin2)) / 2))

  test("the density is one over the solid angle, from any distance"):
    val draws = Draws(1)
    for distance <- distances ++ Seq.fill(1000)(draws.magnitude(1.001, 1e5)) do
      val from = away(distance, draws)
      val exact = 1 / (2 * Math.PI * oneMinusCos(from))
      val off = Math.abs(SphereSampling.conePdf(centre, 0.5f, from) / exact - 1)
      // It is rounded to Float once
      assert(off < 1.01 * MachineEpsilon, s"$distance: $off")

  test("samples fill the cone evenly, from any distance"):
    val draws = Draws(2)
    for (distance, i) <- distances.zipWithIndex do
      val from = away(distance, draws)
      val axis = (centre - from).normalized
      val result = SampledShapes.coneChiSquare(seed = i, sphere, from, axis, oneMinusCos(from))
      assert(result.accepted(tests = distances.size), s"$distance: $result")

  test("sample and pdf agree, and samples lie on the side of the sphere that is seen"):
    val draws = Draws(3)
    val out = SurfaceSample()
    for distance <- distances do
      val from = away(distance, draws)
      SampledShapes.pdfAgrees(sphere, from, draws)
      for _ <- 0 until 2000 do
        sphere.sample(from, draws.unit(), draws.unit(), out)
        // 8 round-offs of numbers of size 1
        assert(abs((out.p - centre).length - 0.5f) < 5e-7f)
        assert((out.n - (out.p - centre).normalized).length < 2e-6f)
        // Zero at the silhouette; from 5e-4 away 1e-7 of rounding is 2e-4 of the direction
        assert((out.n dot (from - out.p).normalized) > -1e-3f, s"$distance ${out.n}")

  test("the error bound of a sample holds: the sphere passes through its box"):
    val draws = Draws(4)
    val out = SurfaceSample()
    for _ <- 0 until 20000 do
      val size = draws.magnitude(1e-3, 1e4)
      val c = draws.vec(-5, 5) * size
      val from = c + draws.direction() * (size * draws.magnitude(1.01, 1e3))
      SphereSampling.cone(c, size, from, draws.unit(), draws.unit(), out)
      val (x, y, z) = (out.p.x.toDouble - c.x, out.p.y.toDouble - c.y, out.p.z.toDouble - c.z)
      val r = Math.sqrt(x * x + y * y + z * z)
      val reach =
        (Math.abs(x) * out.pError.x + Math.abs(y) * out.pError.y +
          Math.abs(z) * out.pError.z) / r
      assert(Math.abs(r - size) <= reach, s"$c $size ${out.p}")
