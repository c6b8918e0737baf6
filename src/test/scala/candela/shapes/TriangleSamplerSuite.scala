package candela.shapes

import org.scalatest.funsuite.AnyFunSuite
import org.scalatest.tagobjects.Slow

import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.testing.{Draws, Soups}

class TriangleSamplerSuite extends AnyFunSuite:
  private val triangle = (Vec3(1f, 0f, 2f), Vec3(3f, 0.5f, 2f), Vec3(1f, 4f, 1f))
  private val soup = Soups.of(Seq(triangle))
  private val sampler = TriangleSampler(soup, 0)
  private val ray = Ray()
  private val hit = Hit()

  private val see: SampledShapes.Visible = (from, w) =>
    ray.set(from, w, Float.PositiveInfinity)
    Option.when(TriangleTest.intersect(soup.positions, 0, ray, hit))(
      (ray.at(ray.tMax), sampler.normal)
    )

  test("area and normal are those of the triangle"):
    // |(2, 0.5, 0) × (0, 4, −1)| / 2 = |(−0.5, 2, 8)| / 2
    assert(abs(sampler.area - 0.5f * sqrt(0.25f + 4f + 64f)) < 1e-6f)
    assert((sampler.normal - Vec3(-0.5f, 2f, 8f).normalized).length < 1e-6f)
    val flipped = TriangleSampler(Soups.of(Seq(triangle), flipped = true), 0)
    assert(flipped.normal == -sampler.normal)

  test("directions to samples are as dense as the pdf says, from either side", Slow):
    val eyes = Seq(Vec3(1f, 1f, 4f), Vec3(2f, 1f, -1f), Vec3(1.5f, 1.5f, 2.2f))
    for (from, i) <- eyes.zipWithIndex do
      val result = SampledShapes.chiSquare(seed = i, sampler, see, from)
      assert(result.accepted(tests = 3), s"$from $result")
      SampledShapes.integrates(sampler, see, from, Draws(i))(w => 1 + w.x + w.y * w.z)

  test("sample and pdf agree"):
    val draws = Draws(1)
    for _ <- 0 until 20 do SampledShapes.pdfAgrees(sampler, draws.vec(-5, 5), draws)

  test("a point in the triangle's plane gets no sample"):
    val out = SurfaceSample()
    val floor = TriangleSampler(Soups.of(Seq((Vec3.Zero, Vec3.X, Vec3.Y))), 0)
    floor.sample(Vec3(3f, 3f, 0f), 0.3f, 0.6f, out)
    assert(out.pdf == 0f && floor.pdf(Vec3(3f, 3f, 0f), out.p, out.n) == 0f)

  // pbrt orients normals point by point, too: a lamp of two such triangles lights 4 % less
  test("normals of samples are those that rays see, also if the vertices' lie on both sides"):
    val normals = Array[Float](0, 0, 1, 0, 0, 1, 0, 0, -1)
    val mesh = Mesh(0, 0, 1, normals, Array.empty, false, material = 0, firstLight = -1)
    val twisted = TriangleSoup(soup.positions, Array(0, 1, 2), Array(mesh), tangents = true)
    val eye = Vec3(2f, 1f, 5f)
    val (at, out, draws) = (ShadingPoint(), SurfaceSample(), Draws(1))
    for isInverted <- Seq(false, true) do
      val lamp = TriangleSampler(twisted, 0, isInverted)
      val sides = Seq.fill(100):
        lamp.sample(eye, draws.unit(), draws.unit(), out)
        ray.set(eye, out.p - eye, Float.PositiveInfinity)
        assert(lamp.intersectSurface(ray, hit, at))
        assert(out.n == (if isInverted then -at.geometricNormal else at.geometricNormal))
        out.n.z > 0f
      assert(sides.distinct.size == 2)
    assert(!sampler.isTwisted)
