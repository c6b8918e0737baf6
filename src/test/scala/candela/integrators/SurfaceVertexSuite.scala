package candela.integrators

import candela.bsdf.PhaseLobe
import candela.color.Rgb
import candela.geometry.Ray
import candela.lights.PointLight
import candela.math.Vec3
import candela.sampling.{HenyeyGreenstein, IndependentSampler}
import candela.testing.PlainScene

import org.scalatest.funsuite.AnyFunSuite

final class SurfaceVertexSuite extends AnyFunSuite:
  private val scene =
    val light = PointLight(Vec3.Zero, Rgb.White)
    PlainScene(Rgb.White, light)

  for g <- Seq(-0.99f, -0.9f, 0f, 0.5f, 0.99f) do
    test(s"directions keep their length over ten thousand events in a medium of g $g"):
      val sampler = IndependentSampler(1, 1)
      sampler.start(0, 0, 0)
      val (vertex, ray, lobe) = (SurfaceVertex(scene), Ray(), PhaseLobe(HenyeyGreenstein(g)))
      ray.set(Vec3.Zero, Vec3(0.6f, 0f, 0.8f), 1f)
      for event <- 1 to 10000 do
        vertex.scatterAt(Vec3.Zero, -ray.direction, lobe)
        vertex.draw(sampler)
        assert(vertex.spawnRay(ray))
        // The rounding of one event, not of all
        assert(Math.abs(ray.direction.length - 1f) < 1e-6f, s"${ray.direction}, event $event")
