package candela.lights

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.Draws

final class SphereMapSuite extends AnyFunSuite:
  private val maps = Seq(
    "latitude-longitude" -> LatLongMap,
    "poles within rows" -> PolarLatLongMap(32),
    "equal-area" -> EqualAreaMap
  )

  for (name, map) <- maps do
    test(s"$name: from direction to image and back"):
      val draws = Draws(1)
      for _ <- 1 to 10000 do
        val d = draws.direction()
        val p = map.toImage(d)
        assert(p.x >= 0f && p.x <= 1f && p.y >= 0f && p.y <= 1f)
        // Near the poles 1 − |z| has lost half of its digits: the square root of 6e-8, a few times
        assert((map.toDirection(p.x, p.y) - d).length < 1e-3f, d)

    test(s"$name: from image to direction and back, as unit vectors"):
      val draws = Draws(2)
      for _ <- 1 to 10000 do
        val (x, y) = (draws.between(0.01f, 0.99f), draws.between(0.02f, 0.98f))
        val d = map.toDirection(x, y)
        assert(Math.abs(d.length - 1f) < 1e-5f)
        val p = map.toImage(d)
        assert(
          Math.abs(p.x - x) < 1e-3f && Math.abs(p.y - y) < 1e-3f,
          s"($x, $y) to $p"
        ) // as above

    test(s"$name: stretch is the solid angle of a piece of the image"):
      val draws = Draws(3)
      for _ <- 1 to 200 do
        val (x, y) = (draws.between(0.05f, 0.95f), draws.between(0.05f, 0.95f))
        val h = 2e-3f
        def at(i: Float, j: Float) = map.toDirection(x + i * h, y + j * h)
        val area = ((at(1, 0) - at(-1, 0)) cross (at(0, 1) - at(0, -1))).length / (4 * h * h)
        // Central differences of 2e-3 lose three digits of seven; folds of the octahedron are left
        // out
        val folds = (map eq EqualAreaMap) && {
          val (u, v) = (Math.abs(2 * x - 1), Math.abs(2 * y - 1))
          Math.min(Math.min(u, v), Math.abs(u + v - 1)) < 0.05f
        }
        if !folds then assert(Math.abs(area / map.stretch(y) - 1) < 0.02f, s"($x, $y)"): Unit

    test(s"$name: pixels beyond a border are neighbours on the sphere"):
      val (w, h) = (16, 16)
      def center(x: Int, y: Int) = map.toDirection((x + 0.5f) / w, (y + 0.5f) / h)
      for k <- 2 until 14; (x, y, ix, iy) <- Seq((-1, k, 0, k), (w, k, w - 1, k)) do
        val (ox, oy) = (map.wrapX(x, y, w, h), map.wrapY(x, y, w, h))
        assert(ox >= 0 && ox < w && oy >= 0 && oy < h)
        // A pixel is at most a fifth of π wide here
        assert((center(ox, oy) - center(ix, iy)).length < 0.65f, s"($x, $y) is ($ox, $oy)")

  test("latitude-longitude: the top is +z, the left edge +x, a quarter along +y"):
    assert((LatLongMap.toDirection(0.3f, 0f) - Vec3.Z).length < 1e-6f) // rounding of sin π, cos π
    assert((LatLongMap.toDirection(0f, 0.5f) - Vec3.X).length < 1e-6f)
    assert((LatLongMap.toDirection(0.25f, 0.5f) - Vec3.Y).length < 1e-6f)

  test("equal-area: the middle is +z, the corners −z, the right edge's middle +x"):
    assert((EqualAreaMap.toDirection(0.5f, 0.5f) - Vec3.Z).length < 1e-6f) // rounding
    assert((EqualAreaMap.toDirection(0f, 0f) + Vec3.Z).length < 1e-6f)
    assert((EqualAreaMap.toDirection(1f, 0.5f) - Vec3.X).length < 1e-6f)
    assert((EqualAreaMap.toDirection(0.5f, 1f) - Vec3.Y).length < 1e-6f)
