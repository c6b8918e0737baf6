package candela.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.testing.Draws

class CurveSuite extends AnyFunSuite:
  private val ray = Ray()
  private val hit = Hit()
  private val at = ShadingPoint(wantsPartials = true)

  /** A gently bent curve of about length 3. */
  private def bent(draws: Draws): Array[Double] =
    val start = draws.vec(-1, 1)
    val along = draws.direction()
    val p = Seq.tabulate(4)(i => start + along * i.toFloat + draws.vec(-0.4f, 0.4f))
    p.flatMap(q => Seq(q.x.toDouble, q.y.toDouble, q.z.toDouble)).toArray

  private def point(c: Array[Double], u: Double): Vec3 =
    val p = BezierCurve.subcurve(c, u, u)
    Vec3(p(0).toFloat, p(1).toFloat, p(2).toFloat)

  private def tangent(c: Array[Double], u: Double): Vec3 =
    (point(c, u + 1e-3) - point(c, u - 1e-3)) * 500f

  private def segments(
      c: Array[Double],
      w0: Float,
      w1: Float,
      kind: CurveKind = CurveKind.Flat,
      toWorld: Transform = Transform.Identity,
      normals: Option[(Vec3, Vec3)] = None,
      depth: Int = 3
  ): CurveSegments =
    val curve = BezierCurve(c, w0, w1, normals)
    CurveBuilder.segments(Seq(curve), CurveForm(kind, depth, 2), toWorld, reversed = false)

  /** The segment that is met first, or −1; `hit` and `ray.tMax` are its. */
  private def first(s: CurveSegments): Int =
    var found = -1
    for i <- 0 until s.count do
      val end = ray.tMax
      val isHit = s.isHit(i, ray)
      val now = s.intersect(i, ray, hit)
      assert(now == isHit && ray.tMax <= end)
      if now then found = i
    found

  private def aim(from: Vec3, to: Vec3): Unit =
    ray.set(from, (to - from).normalized, Float.PositiveInfinity)

  test("the box of a segment holds what rays meet of it, thin at either end"):
    val draws = Draws(2)
    var hits = 0
    for (w0, w1) <- Seq((0.02f, 0.6f), (0.6f, 0.02f)); _ <- 0 until 300 do
      val c = bent(draws)
      val s = segments(c, w0, w1, depth = draws.below(3))
      val u = draws.unit()
      val target = point(c, u) + draws.direction() * (0.5f * lerp(u, w0, w1))
      aim(target + draws.direction() * 4f, target)
      val segment = first(s)
      if segment >= 0 then
        hits += 1
        val box = s.bounds(segment)
        val p = ray.origin + ray.direction * ray.tMax
        // The ray ends in Float, from 4 away
        val isIn = (0 until 3).forall(k => p(k) >= box.min(k) - 1e-5f && p(k) <= box.max(k) + 1e-5f)
        assert(isIn, s"$p in $box"): Unit
    assert(hits > 200, hits)

  test("a ray meets a curve where it passes it within half of its width, and nowhere else"):
    val draws = Draws(1)
    var (hits, misses) = (0, 0)
    for _ <- 0 until 400 do
      val c = bent(draws)
      val (w0, w1) = (draws.between(0.02f, 0.2f), draws.between(0.02f, 0.2f))
      val s = segments(c, w0, w1, depth = draws.below(5))
      val target = point(c, draws.unit()) + draws.direction() * draws.between(0, 0.15f)
      aim(target + draws.direction() * 4f, target)
      val (o, d) = (ray.origin, ray.direction)
      // How far the curve passes the ray, in half widths, at many places
      val n = 400
      val places = Seq.tabulate(n + 1)(_.toDouble / n)
      val passing = places.map: u =>
        val q = point(c, u) - o
        (q - d * (q dot d)).length / (0.5f * lerp(u.toFloat, w0, w1))
      val i = passing.indices.minBy(passing)
      val u = places(i)
      val facing = (tangent(c, Math.max(0.001, Math.min(0.999, u))).normalized cross d).length
      // Seen end-on it is not as a strip; near its ends there is a cap; linear pieces are right
      // to a tenth of half a width
      if facing > 0.5f && u > 0.02 && u < 0.98 && Math.abs(passing(i) - 1) > 0.15 then
        val found = first(s)
        assert((found >= 0) == (passing(i) < 1), s"${passing(i)} at $u")
        if found >= 0 then
          hits += 1
          s.surface(found, ray, hit, at)
          assert(abs(at.v - 0.5f) <= 0.5f && at.u >= 0f && at.u <= 1f)
          val q = point(c, at.u.toDouble) - o
          val off = (q - d * (q dot d)).length
          val width = lerp(at.u, w0, w1)
          assert(abs(abs(at.v - 0.5f) * width - off) < 0.1f * width, s"v ${at.v}, off $off")
          assert(s.bounds(found).union(at.p).extent == s.bounds(found).extent): Unit
        else misses += 1
    assert(hits > 80 && misses > 50)

  test("no ray that is aimed at the middle of a curve passes between its segments"):
    val draws = Draws(2)
    for _ <- 0 until 5000 do
      val c = bent(draws)
      val depth = draws.below(5)
      val s = segments(c, 0.01f, 0.03f, depth = depth)
      val u = draws.below(1 << depth).toDouble / (1 << depth)
      val inner = if u > 0 then u else draws.between(0.01f, 0.99f).toDouble
      aim(draws.direction() * 6f, point(c, inner))
      assert(first(s) >= 0)

  test("u runs along the curve, v across it; flat ones face along the ray"):
    val draws = Draws(3)
    for _ <- 0 until 2000 do
      val c = bent(draws)
      val s = segments(c, 0.1f, 0.1f)
      val u = draws.between(0.05f, 0.95f)
      val target = point(c, u.toDouble)
      val from = target + draws.direction() * 3f
      val t = tangent(c, u.toDouble)
      val side = (t cross (target - from)).normalized
      val facing = (t.normalized cross (target - from).normalized).length
      if facing > 0.5f then
        val step = draws.between(-0.04f, 0.04f)
        aim(from, target + side * step)
        val found = first(s)
        assert(found >= 0)
        s.surface(found, ray, hit, at)
        // Other parts of the curve may be before this one
        if abs(at.u - u) < 0.05f then
          assert((at.dpdu - t).length < 0.25f * t.length)
          assert(abs(at.dpdv.length - 0.1f) < 1e-5f)
          val across = 0.1f * (at.v - 0.5f)
          val towards = at.dpdv.normalized dot side
          // The nearest point is found by the chord, a bit before or behind; so in pbrt
          assert(abs(across * Math.signum(towards) - step) < 0.02f, s"$across $step")
          assert(
            (at.geometricNormal dot ray.direction) > 0.4f && abs(at.frame.s dot t) > 0.9f
          ): Unit

  test("a round curve's normals turn from edge to edge"):
    val straight = Array[Double](0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0)
    val s = segments(straight, 0.2f, 0.2f, CurveKind.Cylinder)
    for (y, cosine) <- Seq((0f, 1f), (0.0999f, 0f), (-0.0999f, 0f), (0.05f, sqrt(0.5f))) do
      ray.set(Vec3(1.3f, y, 5), -Vec3.Z, Float.PositiveInfinity)
      val found = first(s)
      assert(found >= 0)
      s.surface(found, ray, hit, at)
      assert(abs((at.geometricNormal dot -Vec3.Z) - cosine) < 2e-3f)
      assert(y == 0f || at.geometricNormal.y * y > 0f)
      assert(abs(at.u - 1.3f / 3) < 1e-5f && abs(ray.tMax - 5f) < 1e-5f)

  test("a ribbon is as wide as its normals let it look"):
    val straight = Array[Double](0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0)
    val turn = Math.toRadians(60)
    val tilted = Vec3(0, Math.sin(turn).toFloat, Math.cos(turn).toFloat)
    val s = segments(straight, 1f, 1f, CurveKind.Ribbon, normals = Some((Vec3.Z, tilted)))
    def isMet(x: Float, y: Float) =
      ray.set(Vec3(x, y, 5), -Vec3.Z, Float.PositiveInfinity)
      first(s) >= 0
    for u <- Seq(0.02, 0.25, 0.5, 0.75, 0.98) do
      val half = (0.5 * Math.cos(turn * u)).toFloat
      val x = (3 * u).toFloat
      assert(isMet(x, half - 0.01f) && isMet(x, 0.01f - half))
      assert(!isMet(x, half + 0.01f) && !isMet(x, -half - 0.01f), u)
    ray.set(Vec3(1.5f, 0.1f, 5), -Vec3.Z, Float.PositiveInfinity)
    s.surface(first(s), ray, hit, at)
    val expected = Vec3(0, 0.5f, Math.cos(turn / 2).toFloat)
    assert((at.geometricNormal absDot expected) > 0.9999f)

  test("curves stay what they are when they are turned, moved and scaled alike"):
    val draws = Draws(4)
    val (other, otherHit) = (Ray(), Hit())
    var hits = 0
    for i <- 0 until 400 do
      val c = bent(draws)
      val kind = CurveKind.fromOrdinal(i % 3)
      val toWorld = draws.translation(3) * draws.rotation() * Transform.scale(2, 2, 2).get
      val normals = Option.when(kind == CurveKind.Ribbon)((draws.direction(), draws.direction()))
      val curve = BezierCurve(c, 0.2f, 0.1f, normals)
      val moved = CurveBuilder.segments(Seq(curve), CurveForm(kind, 2, 2f), toWorld, false)
      val kept = new CurveBuilder(CurveForm(kind, 2, 2f), Some(toWorld), false)
      kept.add(Seq(curve), toWorld)
      val inSpace = kept.result()
      val target = toWorld.point(point(c, draws.unit()))
      for k <- 0 until moved.count do
        aim(draws.direction() * 9f, target)
        other.set(ray.origin, ray.direction, Float.PositiveInfinity)
        val found = moved.intersect(k, ray, hit)
        if found && inSpace.intersect(k, other, otherHit) then
          hits += 1
          assert(abs(ray.tMax - other.tMax) < 1e-4f && Math.abs(hit.u - otherHit.u) < 1e-3)
          assert(Math.abs(hit.v - otherHit.v) < 0.02)
          moved.surface(k, ray, hit, at)
          val (n, e) = (at.geometricNormal, at.pError)
          inSpace.surface(k, other, otherHit, at)
          assert((at.geometricNormal - n).length < 0.05f)
          // |M|·e is e scaled, at most √3 times
          assert(at.pError.length < 2 * e.length && e.length < 2 * at.pError.length): Unit
    assert(hits > 200)

  test("mirrored and stretched curves are met where they are"):
    val draws = Draws(5)
    for _ <- 0 until 1000 do
      val c = bent(draws)
      val toWorld = draws.rotation() * draws.stretch()
      val s = segments(c, 0.05f, 0.05f, toWorld = toWorld)
      val u = draws.between(0.05f, 0.95f)
      val target = toWorld.point(point(c, u.toDouble))
      aim(target + draws.direction() * 8f, target)
      val found = first(s)
      assert(found >= 0)
      s.surface(found, ray, hit, at)
      assert(s.bounds(found).union(at.p).extent.length <= s.bounds(found).extent.length * 1.0001f)

  test("rays that leave a straight curve don't meet it again"):
    val draws = Draws(6)
    for _ <- 0 until 20000 do
      val (a, d) = (draws.vec(-1, 1), draws.direction())
      val c = Seq.tabulate(4)(i => a + d * i.toFloat)
        .flatMap(q => Seq(q.x.toDouble, q.y.toDouble, q.z.toDouble)).toArray
      val s = segments(c, 0.1f, 0.1f, if draws.coin() then CurveKind.Flat else CurveKind.Cylinder)
      val target = point(c, draws.between(0.1f, 0.9f).toDouble)
      aim(target + draws.direction() * 3f, target)
      val found = first(s)
      if found >= 0 then
        s.surface(found, ray, hit, at)
        val leave = draws.direction()
        ray.set(at.offsetOrigin(leave), leave, Float.PositiveInfinity)
        // In the direction of the curve it may pass the end, and the next segment's
        if (leave absDot at.geometricNormal) > 0.1f then assert(first(s) < 0): Unit
