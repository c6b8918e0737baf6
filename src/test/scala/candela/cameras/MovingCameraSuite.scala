package candela.cameras

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.Ray
import candela.math.*
import candela.testing.Draws

class MovingCameraSuite extends AnyFunSuite:

  private def camera(toWorld: Transform): Camera =
    PerspectiveCamera(ProjectiveSetup(toWorld, 60, 40, (-1.5f, 1.5f, -1f, 1f), 0.1f, 3f), 40f)

  test("at any time its rays are those of a camera that stands where it then is"):
    val draws = Draws(1)
    val (ray, expected) = (Ray(), Ray())
    for _ <- 0 until 50 do
      val a = draws.translation(5) * draws.rotation()
      val b = draws.translation(5) * draws.rotation()
      val motion = Interpolation(a, b, 0f, 1f, shortest = true)
      val moving = MovingCamera(camera(Transform.Identity), motion)
      for _ <- 0 until 20 do
        ray.time = draws.between(-0.2f, 1.2f)
        val (x, y, u, v) = (draws.between(0, 60), draws.between(0, 40), draws.unit(), draws.unit())
        moving.generate(x, y, u, v, ray)
        camera(motion.transform(ray.time)).generate(x, y, u, v, expected)
        assert((ray.origin - expected.origin).length < 1e-5f)
        assert((ray.direction - expected.direction).length < 1e-5f)
        assert(ray.tMax == Float.PositiveInfinity): Unit

  test("the shutter's times go from its opening to its closing"):
    val shutter = Shutter(0.2f, 0.6f)
    assert(shutter.at(0f) == 0.2f && Math.abs(shutter.at(0.5f) - 0.4f) < 1e-6f)
