package candela.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.testing.Draws

class QuadricSuite extends AnyFunSuite:
  private val ray = Ray()
  private val hit = Hit()
  private val at = ShadingPoint()

  private def times(m: IArray[Double], v: Array[Double], w: Double): Array[Double] =
    Array.tabulate(3)(i =>
      m(4 * i) * v(0) + m(4 * i + 1) * v(1) + m(4 * i + 2) * v(2) + m(4 * i + 3) * w
    )
  private def doubles(v: Vec3): Array[Double] = Array(v.x, v.y, v.z)
  private def floats(v: Array[Double]): Vec3 = Vec3(v(0).toFloat, v(1).toFloat, v(2).toFloat)

  private def placement(draws: Draws, size: Float): Transform =
    draws.translation(5 * size) * draws.rotation() * draws.stretch() * draws.rotation()

  /** Aims a ray from about the shape at the point (u, v) of it. */
  private def aim(draws: Draws, q: SweptQuadric, toWorld: Transform, u: Double, v: Double): Vec3 =
    val target = floats(times(toWorld.m, q.point(u, v), 1))
    val o = target + draws.direction() * (q.size * draws.between(0.3f, 6))
    ray.set(o, (target - o).normalized, Float.PositiveInfinity)
    target

  test("the line that sweeps a quadric lies on it"):
    val draws = Draws(1)
    for i <- 0 until 2000 do
      val q = Quadrics.random(draws, i, 1)
      val p = q.point(draws.unit(), draws.unit())
      val off = p(0) * p(0) + p(1) * p(1) - q.profile.radius2(p(2))
      // waist and tilt are rounded to Float in the hyperboloid's corners
      assert(Math.abs(off) < 1e-5, q.name)

  test("hits are the first root of the implicit function along the ray, found by bisection"):
    val draws = Draws(2)
    var hits = 0
    for i <- 0 until 1000 do
      val size = draws.magnitude(1e-2, 1e2)
      val q = Quadrics.whole(draws, i, size)
      val toWorld = placement(draws, size)
      val shape = q.placed(toWorld)
      val _ = aim(draws, q, toWorld, draws.between(-0.2f, 1.2f), draws.between(0.01f, 1.4f))
      val o = times(toWorld.inverseM, doubles(ray.origin), 1)
      val d = times(toWorld.inverseM, doubles(ray.direction), 0)
      def point(t: Double) = Array.tabulate(3)(k => o(k) + t * d(k))
      val roots = rootsUpTo(t => q.implicit_(point(t)), 40.0 * size)
      val first = roots.filter: t =>
        val z = point(t)(2)
        z > q.profile.zMin && z < q.profile.zMax
      val clear = roots.forall: t =>
        val z = point(t)(2)
        Seq(q.profile.zMin, q.profile.zMax).forall(e => Math.abs(z - e) > 1e-4 * size)
      if clear then
        assert(shape.isHit(ray) == first.nonEmpty || first.isEmpty, s"${q.name} $first")
        if shape.isHit(ray) then
          assert(shape.intersect(ray, hit))
          // Near a horizon bisection may overlook a pair of roots, or step over the first
          for t <- first.headOption do
            hits += 1
            assert(ray.tMax <= t + 1e-5 * size, s"${q.name} ${ray.tMax} $t")
            val residual = q.implicit_(point(ray.tMax.toDouble)) / (size * size)
            assert(Math.abs(residual) < 1e-3, s"${q.name} $residual")
            ray.tMax = ray.tMax * 0.999f
            assert(!shape.isHit(ray) && !shape.intersect(ray, hit))
    assert(hits > 300)

  /** Where f changes its sign in (0, end), to Double's precision. */
  private def rootsUpTo(f: Double => Double, end: Double): Seq[Double] =
    val steps = 400
    for
      k <- 0 until steps
      (a, b) = (end * k / steps, end * (k + 1) / steps)
      if (f(a) < 0) != (f(b) < 0)
    yield
      var (low, high) = (a, b)
      for _ <- 0 until 50 do
        val middle = (low + high) / 2
        if (f(middle) < 0) == (f(a) < 0) then low = middle else high = middle
      low

  test("a ray that is aimed at (u, v) finds that point, or another before it"):
    val draws = Draws(3)
    var direct = 0
    for i <- 0 until 10000 do
      val size = draws.magnitude(1e-2, 1e2)
      val q = Quadrics.random(draws, i, size)
      val toWorld = placement(draws, size)
      val shape = q.placed(toWorld)
      val (u, v) = (draws.between(0.01f, 0.99f), draws.between(0.02f, 0.98f))
      val target = aim(draws, q, toWorld, u, v)
      val origin = ray.origin
      val distance = (target - origin).length
      val n = toWorld
        .normal(floats(gradient(q, times(toWorld.inverseM, doubles(target), 1))))
        .normalized
      // The target is rounded to Float, 5 sizes from the origin: edge-on the ray may pass it by
      if (n absDot ray.direction) > 0.05f then
        assert(shape.isHit(ray), s"${q.name} $u $v")
        assert(shape.intersect(ray, hit) && ray.tMax <= distance + 1e-3f * size)
        if ray.tMax > distance - 1e-3f * size then
          direct += 1
          shape.surface(ray, hit, at)
          assert((at.p - target).length < 2e-3f * size)
          // Where the surface is narrow an angle is a short way
          val p = times(toWorld.inverseM, doubles(at.p), 1)
          val wide = Math.hypot(p(0), p(1)) / size
          assert(Math.abs(at.u - u) * wide < 1e-2, s"${q.name} ${at.u} $u")
          assert(Math.abs(at.v - v) < 2e-2, s"${q.name} ${at.v} $v"): Unit
    assert(direct > 5000)

  /** By differences. */
  private def gradient(q: SweptQuadric, p: Array[Double]): Array[Double] =
    val h = 1e-6 * q.size
    Array.tabulate(3): k =>
      (q.implicit_(p.updated(k, p(k) + h)) - q.implicit_(p.updated(k, p(k) - h))) / (2 * h)

  test("hit points are on the surface to their error bound, with normals outwards or reversed"):
    val draws = Draws(4)
    for i <- 0 until 20000 do
      val size = draws.magnitude(1e-2, 1e2)
      val q = Quadrics.random(draws, i, size)
      val toWorld = placement(draws, size)
      val reversed = draws.coin()
      val shape = q.placed(toWorld, reversed)
      val _ = aim(draws, q, toWorld, draws.unit(), draws.between(0.05f, 0.95f))
      if shape.intersect(ray, hit) then
        val (o, d, t) = (ray.origin, ray.direction, ray.tMax)
        shape.surface(ray, hit, at)
        assert((o + d * t - at.p).length < 1e-4f * size)
        val p = times(toWorld.inverseM, doubles(at.p), 1)
        val g = gradient(q, p)
        val m = toWorld.inverseM
        val inWorld = Array.tabulate(3)(k => m(k) * g(0) + m(4 + k) * g(1) + m(8 + k) * g(2))
        val length = Math.sqrt(inWorld.map(x => x * x).sum)
        // Newton's step from the point is along the gradient: its length in the world
        val bound =
          (Math.abs(inWorld(0)) * at.pError.x + Math.abs(inWorld(1)) * at.pError.y +
            Math.abs(inWorld(2)) * at.pError.z) / length
        val off = Math.abs(q.implicit_(p)) / length
        // waist and tilt of a hyperboloid's corners are rounded to Float
        val rounding = if q.name == "hyperboloid" then 3e-6 * size else 1e-10 * size
        assert(off <= bound + rounding, s"${q.name} $off $bound")
        val n = floats(inWorld.map(_ / length)) * (if reversed then -1f else 1f)
        assert((at.geometricNormal - n).length < 1e-3f, q.name)
        assert(at.frame.n == at.geometricNormal)
        assert(abs(at.frame.s dot at.frame.n) < 1e-6f)
        val along = floats(times(toWorld.m, Array(-p(1), p(0), 0), 0)).normalized
        val wide = Math.hypot(p(0), p(1)) / size
        assert(wide < 0.02 || (at.frame.s dot along) > 0.999f, "s follows ∂p/∂u"): Unit

  test("the bounds hold all points"):
    val draws = Draws(6)
    val out = SurfaceSample()
    for i <- 0 until 400 do
      val size = draws.magnitude(1e-2, 1e2)
      val shape = Quadrics.random(draws, i, size).placed(placement(draws, size))
      val box = shape.bounds
      for _ <- 0 until 20 do
        shape.sample(box.center, draws.unit(), draws.unit(), out)
        assert(box.union(out.p) == box)

  test("a line of one height sweeps no hyperboloid"):
    assert(Profile.hyperboloid(Vec3(1, 0, 2), Vec3(2, 0, 2)).isEmpty)
    assert(Profile.hyperboloid(Vec3(1, 0, 0), Vec3(1, 1, 1)).isDefined)

  test("along the axis of a cylinder and along a cone's side a ray meets nothing"):
    val cylinder = Quadrics.cylinder(1, -1, 1, TwoPi).placed(Transform.Identity)
    ray.set(Vec3(0.5f, 0, -3), Vec3.Z, Float.PositiveInfinity)
    assert(!cylinder.isHit(ray))
    ray.set(Vec3(1, 0, -3), Vec3.Z, Float.PositiveInfinity)
    assert(!cylinder.isHit(ray))
    val cone = Quadrics.cone(1, 1, TwoPi).placed(Transform.Identity)
    ray.set(Vec3(1.5f, 0, 0), Vec3(-1, 0, 1), Float.PositiveInfinity)
    assert(!cone.isHit(ray))
    ray.set(Vec3(0.5f, 0, 0.25f), Vec3(-1, 0, 1), Float.PositiveInfinity)
    assert(cone.isHit(ray))
