package candela.cameras

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.{Frame, Ray}
import candela.math.*
import candela.testing.Draws

/** Where a point is seen is where rays to it come from. */
final class FilmPlaceSuite extends AnyFunSuite:
  private val placed = Transform.translate(1, 2, 3) * Draws(3).rotation()
  private def rows(m: Double*): Transform = Transform.fromRows(m.toVector).get
  private val sheared = rows(1, 0.5, -0.2, 0, 0.1, 1, 0.4, 0, 0, -0.3, 1, 0, 0, 0, 0, 1)

  private val spaces: Seq[(String, Transform)] = Seq(
    "mirrored" -> placed * Transform.scale(-2, 2, 2).get,
    "turned by rounded numbers" -> rows(placed.m.map(x => Math.rint(x * 1e4) / 1e4)*),
    "stretched" -> placed * Transform.scale(1, 2, 0.7).get,
    "sheared" -> placed * sheared
  )

  private val cameras: Seq[(String, Transform, Camera)] =
    for
      (space, toWorld) <- spaces
      (name, lens) <- Seq("" -> 0f, " with a lens" -> 0.3f)
      setup = ProjectiveSetup(toWorld, 200, 100, (-2f, 2f, -1f, 1f), lens, 5f)
      (kind, camera) <- Seq(
        "perspective" -> PerspectiveCamera(setup, 60f),
        "orthographic" -> OrthographicCamera(setup)
      )
    yield (s"$kind$name, $space", toWorld, camera)

  for (name, toWorld, camera) <- cameras do
    test(s"$name: a point on a ray is seen where the ray started"):
      val (draws, ray, place) = (Draws(1), Ray(), FilmPlace())
      for _ <- 1 to 500 do
        val (x, y) = (draws.between(-1, 201), draws.between(-1, 101))
        val (u, v) = (draws.unit(), draws.unit())
        camera.generate(x, y, u, v, ray)
        val p = ray.at(draws.magnitude(0.5, 50))
        assert(camera.project(p, u, v, place))
        assert(Math.abs(place.x - x) < 0.02f && Math.abs(place.y - y) < 0.02f)
        assert((place.direction + ray.direction).length < 1e-3f)
        assert(((place.eye - ray.origin) cross ray.direction).length < 1e-3f)
        assert(Math.abs(camera.density(place.eye, p) / place.density - 1f) < 1e-3f)

    test(s"$name: the density is that of rays from all over the film"):
      val (draws, ray, place) = (Draws(2), Ray(), FilmPlace())
      val step = 0.5f
      for _ <- 1 to 200 do
        val (x, y) = (draws.between(0, 200), draws.between(0, 100))
        val (u, v) = (draws.unit(), draws.unit())
        camera.generate(x, y, u, v, ray)
        val p = ray.at(draws.between(8f, 30f))
        val across = Frame.fromZ(ray.direction)
        camera.project(p, u, v, place): Unit
        def at(dx: Float, dy: Float): Vec3 =
          camera.generate(x + dx, y + dy, u, v, ray)
          val t = ((p - ray.origin) dot across.n) / (ray.direction dot across.n)
          ray.at(t) - p
        val right = at(step, 0) - at(-step, 0)
        val down = at(0, step) - at(0, -step)
        val area = (right cross down).length // of one pixel, of 20,000
        assert(Math.abs(place.density * 20000f * area - 1f) < 0.01f)

    test(s"$name: what lies behind is not seen"):
      assert(!camera.project(toWorld.point(Vec3(0.1f, 0, -1)), 0.5f, 0.5f, FilmPlace()))

    test(s"$name: light paths can end there"):
      assert(camera.isTraceable)
