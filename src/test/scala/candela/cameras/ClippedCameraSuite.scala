package candela.cameras

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.Ray
import candela.math.*
import candela.testing.Draws

class ClippedCameraSuite extends AnyFunSuite:
  private val ray, whole = Ray()

  test("rays go from the near plane to the far one, in the same direction"):
    val draws = Draws(1)
    for _ <- 0 until 500 do
      val toWorld = draws.translation(3f) * draws.rotation() * Transform.scale(2, 2, 2).get
      val setup = ProjectiveSetup(toWorld, 30, 20, (-1.5f, 1.5f, -1f, 1f), 0.2f, 2f)
      val cameras = Seq(PerspectiveCamera(setup, 70f), OrthographicCamera(setup))
      for camera <- cameras do
        val clipped = ClippedCamera(camera, toWorld, 0.5f, 4f)
        val (x, y, u, v) = (30 * draws.unit(), 20 * draws.unit(), draws.unit(), draws.unit())
        camera.generate(x, y, u, v, whole)
        clipped.generate(x, y, u, v, ray)
        def inside(t: Float) = toWorld.inverse.point(ray.origin + ray.direction * t)
        assert(Math.abs(inside(0f).z - 0.5f) < 1e-5f && Math.abs(inside(ray.tMax).z - 4f) < 1e-5f)
        assert((ray.direction - whole.direction).length == 0f)
        val onWay = (ray.origin - whole.origin).normalized
        assert((onWay - ray.direction.normalized).length < 1e-5f): Unit

  test("points in front of the near plane and behind the far one are not seen"):
    val setup = ProjectiveSetup(Transform.Identity, 10, 10, (-1f, 1f, -1f, 1f), 0f, 1f)
    val clipped = ClippedCamera(PerspectiveCamera(setup, 90f), Transform.Identity, 1f, 3f)
    val place = FilmPlace()
    def isSeen(z: Float) = clipped.project(Vec3(0.1f, 0.1f, z), 0.5f, 0.5f, place)
    assert(clipped.isTraceable && isSeen(2f) && !isSeen(0.9f) && !isSeen(3.1f))
