package candela.stability

import org.scalatest.funsuite.AnyFunSuite

import candela.math.*
import candela.testing.Draws

/** Chains, mirrors, near-singular maps, and turns near 0 and half a turn. */
class TransformsSuite extends AnyFunSuite:

  test("a thousand turns, moves and stretches and their inverses end where they began"):
    val draws = Draws(1)
    val steps = Seq.fill(1000)(draws.rotation() * draws.translation(1f))
    val there = steps.reduce(_ * _)
    val back = steps.reverse.map(_.inverse).reduce(_ * _)
    val p = Vec3(1f, 2f, 3f)
    // A thousand products of Doubles lose some thousand times 1e-16 of some hundreds
    assert((back.point(there.point(p)) - p).length < 1e-4f)
    assert(((there * back).point(p) - p).length < 1e-6f)

  test("normals stay across their surfaces under any stretch and mirror"):
    val draws = Draws(2)
    for _ <- 0 until 20000 do
      def factor() = draws.magnitude(1e-4, 1e4).toDouble * (if draws.coin() then 1 else -1)
      val t = draws.rotation() * Transform.scale(factor(), factor(), factor()).get *
        draws.rotation()
      val n = draws.direction()
      val along = (n cross draws.direction()).normalized
      val (mapped, normal) = (t.vector(along).normalized, t.normal(n).normalized)
      // A stretch of 1e8 to 1 magnifies Float rounding as much; the median is far below
      val condition = 1e8f
      assert(Math.abs(mapped dot normal) < 1e-7f * condition && normal.isFinite): Unit

  test("near-singular maps are inverted or refused, and never make what is no number"):
    val draws = Draws(3)
    for _ <- 0 until 20000 do
      val e = draws.magnitude(1e-20, 1)
      val rows = Vector.tabulate(16): i =>
        if i >= 12 then (if i == 15 then 1.0 else 0.0)
        else if i % 4 == 3 then draws.between(-9, 9).toDouble
        else draws.between(-1, 1).toDouble
      // The third row is nearly the sum of the first two
      val nearly = (0 until 3).foldLeft(rows)((r, c) =>
        r.updated(8 + c, r(c) + r(4 + c) + e * draws.between(-1, 1))
      )
      for t <- Transform.fromRows(nearly) do
        assert(t.inverseM.forall(java.lang.Double.isFinite))
        val p = draws.vec(-1, 1)
        val q = t.inverse.point(t.point(p))
        assert(q.isFinite): Unit

  test("scales that have no finite inverse are none"):
    for x <- Seq(0.0, -0.0, 1e-320, Double.NaN, Double.PositiveInfinity) do
      assert(Transform.scale(x, 1, 1).isEmpty, s"$x")
      assert(Transform.scale(1, 1, x).isEmpty, s"$x")

  test("motions through turns near 0 and half a turn stay turns"):
    val rows = new Array[Double](Motion.Work)
    for
      degrees <- Seq(0.0, 1e-12, 1e-6, 179.999999, 180.0, 180.000001, 359.999999)
      shortest <- Seq(true, false)
      time <- Seq(0f, 1e-7f, 0.25f, 0.5f, 0.999f, 1f)
    do
      val end = Transform.rotate(degrees, 0.3, -0.5, 0.8).get
      Interpolation(Transform.Identity, end, 0f, 1f, shortest).write(time, rows, 0)
      for i <- 0 until 3; j <- 0 until 3 do
        val dot = (0 until 3).map(k => rows(4 * i + k) * rows(4 * j + k)).sum
        val expected = if i == j then 1.0 else 0.0
        assert(Math.abs(dot - expected) < 1e-9, s"$degrees at $time: $dot"): Unit
