package candela.stability

import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.shapes.*
import candela.testing.Draws
import Checks.assert

/** Where shapes end: two parts leave no gap, and tips and edges have geometry that is finite. */
private object Seams:
  val cases: Seq[Case] = Seq(
    Case("two halves of a sphere meet in its equator", 20000, 10_000_000L)(equator),
    Case("two halves of a sphere meet in its seams", 20000, 10_000_000L)(meridians),
    Case("the tip of a cone is met, and has a normal", 5000, 1_000_000L)(tip),
    Case("poles and curves seen along them have frames", 5000, 1_000_000L)(poles)
  )

  private def equator(count: Long): Unit =
    val lower = Sphere(Transform.Identity, 1f, -1f, 0f, TwoPi, false)
    val upper = Sphere(Transform.Identity, 1f, 0f, 1f, TwoPi, false)
    val draws = Draws(1)
    leavesNoGap(lower, upper, draws, count): () =>
      val angle = draws.between(0, TwoPi)
      Vec3(cos(angle), sin(angle), 0f)

  private def meridians(count: Long): Unit =
    val half = Sphere(Transform.Identity, 1f, -1f, 1f, Pi, false)
    val other = Sphere(Transform.rotate(180, 0, 0, 1).get, 1f, -1f, 1f, Pi, false)
    val draws = Draws(2)
    leavesNoGap(half, other, draws, count): () =>
      val (angle, side) = (draws.between(0, Pi), if draws.coin() then 1f else -1f)
      Vec3(side * sin(angle), 0f, cos(angle))

  private def leavesNoGap(a: Shape, b: Shape, draws: Draws, count: Long)(seam: () => Vec3): Unit =
    val (ray, hit) = (Ray(), Hit())
    var i = 0L
    while i < count do
      val o = draws.direction() * draws.between(0, 0.9f)
      val goal = seam()
      ray.set(o, goal - o, Float.PositiveInfinity)
      assert(a.isHit(ray) || b.isHit(ray), s"from $o to $goal"): Unit
      assert(a.intersect(ray, hit) || b.intersect(ray, hit), s"from $o to $goal"): Unit
      i += 1

  private def tip(count: Long): Unit =
    val draws = Draws(3)
    val (ray, hit, at) = (Ray(), Hit(), ShadingPoint(wantsPartials = true))
    var i = 0L
    while i < count do
      val (r, h) = (draws.magnitude(1e-3, 1e3), draws.magnitude(1e-3, 1e3))
      val cone = Quadrics.cone(r, h, TwoPi).placed(Transform.Identity)
      val goal = Vec3(0f, 0f, h) + draws.direction() * (h * draws.magnitude(1e-12, 1e-3))
      val o = draws.direction() * (r.max(h) * draws.between(1.5f, 4f))
      ray.set(o, goal - o, Float.PositiveInfinity)
      if cone.intersect(ray, hit) then
        cone.surface(ray, hit, at)
        assert(isSound(at), s"${at.p} ${at.geometricNormal} ${at.frame.s} r $r h $h"): Unit
      i += 1

  private def poles(count: Long): Unit =
    val draws = Draws(4)
    val (ray, hit, at) = (Ray(), Hit(), ShadingPoint(wantsPartials = true))
    val straight = Array(-1.0, 0, 0, -0.3, 0, 0, 0.3, 0, 0, 1, 0, 0)
    val strips = CurveKind.values.toSeq.map: kind =>
      val normals = Option.when(kind == CurveKind.Ribbon)((Vec3.Z, Vec3.Y))
      val curve = BezierCurve(straight, 0.1f, 0.1f, normals)
      CurveSegment(
        CurveBuilder.segments(Seq(curve), CurveForm(kind, 0, 1f), Transform.Identity, false),
        0
      )
    val sphere = candela.testing.Soups.sphere(Transform.Identity, 1f)
    var i = 0L
    while i < count do
      val side = if draws.coin() then 1f else -1f
      val small = draws.direction() * (if draws.coin() then 0f else draws.magnitude(1e-30, 1e-3))
      ray.set(small + Vec3(0f, 0f, 3f * side), Vec3(0f, -0f, -side), Float.PositiveInfinity)
      assert(sphere.intersectSurface(ray, hit, at) && isSound(at), s"${at.p} ${at.frame.s}")
      for strip <- strips do
        ray.set(small + Vec3(3f * side, 0f, 0f), Vec3(-side, 0f, -0f), Float.PositiveInfinity)
        if strip.intersectSurface(ray, hit, at) then
          assert(isSound(at), s"${at.p} ${at.geometricNormal} ${at.frame.s} $small"): Unit
      i += 1

  private def isSound(at: ShadingPoint): Boolean =
    def unit(v: Vec3) = Math.abs(v.length - 1f) < 1e-5f
    at.p.isFinite && at.pError.isFinite && unit(at.geometricNormal) && unit(at.frame.n) &&
    unit(at.frame.s) && unit(at.frame.t) && Math.abs(at.frame.s dot at.frame.n) < 1e-5f
