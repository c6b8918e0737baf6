package candela.media

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.Draws

final class MajorantWalkSuite extends AnyFunSuite:
  private val grid = MajorantGrid.of(5, 3, 4)((x0, y0, z0, _, _, _) =>
    Math.round(x0 * 5) + 10f * Math.round(y0 * 3) + 100f * Math.round(z0 * 4)
  )

  test("the cells on a ray's way follow each other without gaps, and each is the ray's own"):
    val draws = Draws(11)
    val walk = MajorantWalk()
    var met = 0
    for _ <- 0 until 20000 do
      val origin = draws.vec(-2f, 3f)
      val direction = draws.direction()
      if walk.enter(origin, direction, 10f, grid) then
        met += 1
        var last = Float.NaN
        while walk.next() do
          assert(last.isNaN || walk.start == last): Unit
          last = walk.end
          val t = 0.5f * (walk.start + walk.end)
          if walk.end - walk.start > 1e-4f then
            val p = origin + direction * t
            def cell(v: Float, n: Int) = (v * n).toInt
            val expected = cell(p.x, 5) + 10f * cell(p.y, 3) + 100f * cell(p.z, 4)
            assert(walk.majorant == expected, p): Unit
    assert(met > 500)

  test("it enters the box and leaves it where the ray does, or ends with the ray"):
    val walk = MajorantWalk()
    assert(walk.enter(Vec3(-1f, 0.5f, 0.5f), Vec3.X, 10f, grid))
    assert(walk.next() && walk.start == 1f)
    while walk.next() do ()
    assert(Math.abs(walk.end - 2f) < 1e-6f)
    assert(walk.enter(Vec3(-1f, 0.5f, 0.5f), Vec3.X, 1.5f, grid))
    while walk.next() do ()
    assert(walk.end == 1.5f)
    assert(!walk.enter(Vec3(-1f, 0.5f, 0.5f), Vec3.X, 0.9f, grid))
    assert(!walk.enter(Vec3(-1f, 1.5f, 0.5f), Vec3.X, 10f, grid))

  test("the bounds of samples hold for what lies between them"):
    val draws = Draws(4)
    val samples = SampledGrid(7, 20, 1, Array.fill(140)(draws.unit()))
    val bounds = MajorantGrid.of(7, 20, 1)(samples.majorant)
    for _ <- 0 until 20000 do
      val p = draws.vec(0f, 1f)
      val cell = bounds((p.x * bounds.nx).toInt, (p.y * bounds.ny).toInt, 0)
      assert(samples(p.x, p.y, p.z) <= cell + 1e-6f, p)
