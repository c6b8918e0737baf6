package candela.shapes

import org.scalatest.Assertion
import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.testing.{Draws, Soups}

class SphereSuite extends AnyFunSuite:
  private val ray = Ray()
  private val hit = Hit()
  private val at = ShadingPoint()

  private final case class Cut(
      toWorld: Transform,
      r: Float,
      zMin: Float,
      zMax: Float,
      phiMax: Float,
      reversed: Boolean
  ):
    val sphere: Sphere = Sphere(toWorld, r, zMin, zMax, phiMax, reversed)

  private def cut(draws: Draws): Cut =
    val r = draws.magnitude(1e-2, 1e2)
    val toWorld = draws.translation(5 * r) * draws.rotation() * draws.stretch() * draws.rotation()
    val (zMin, zMax, phiMax) =
      if draws.coin() then (-r, r, TwoPi)
      else (draws.between(-r, 0), draws.between(0.1f * r, r), draws.between(0.5f, TwoPi))
    Cut(toWorld, r, zMin, zMax, phiMax, draws.coin())

  private def times(m: IArray[Double], v: Array[Double], w: Double): Array[Double] =
    Array.tabulate(3)(i =>
      m(4 * i) * v(0) + m(4 * i + 1) * v(1) + m(4 * i + 2) * v(2) + m(4 * i + 3) * w
    )

  private def doubles(v: Vec3): Array[Double] = Array(v.x, v.y, v.z)
  private def dot(a: Array[Double], b: Array[Double]) = a(0) * b(0) + a(1) * b(1) + a(2) * b(2)

  private def phi(p: Array[Double]): Double =
    val a = Math.atan2(p(1), p(0))
    if a < 0 then a + 2 * Math.PI else a

  private def shoot(draws: Draws, c: Cut): Unit =
    val o = c.toWorld.point(draws.direction() * (c.r * draws.between(0, 4)))
    val target = c.toWorld.point(draws.direction() * (c.r * draws.between(0, 1.2f)))
    ray.set(o, (target - o).normalized, Float.PositiveInfinity)

  test("hits are those of the quadratic formula in Double, whole and cut"):
    val draws = Draws(1)
    var hits = 0
    for _ <- 0 until 50000 do
      val c = cut(draws)
      shoot(draws, c)
      val o = times(c.toWorld.inverseM, doubles(ray.origin), 1)
      val d = times(c.toWorld.inverseM, doubles(ray.direction), 0)
      val (qa, qb, qc) = (dot(d, d), 2 * dot(o, d), dot(o, o) - c.r.toDouble * c.r)
      val discriminant = qb * qb - 4 * qa * qc
      val roots =
        if discriminant < 0 then Seq()
        else Seq(-1, 1).map(s => (-qb + s * Math.sqrt(discriminant)) / (2 * qa))
      def point(t: Double) = Array.tabulate(3)(i => o(i) + t * d(i))
      def kept(t: Double) =
        val p = point(t)
        val isWhole = c.zMin == -c.r
        t > 0 && (isWhole || (p(2) >= c.zMin && p(2) <= c.zMax && phi(p) <= c.phiMax))
      // Where a cut or the horizon is nearer than Double resolves, both answers are right
      val clear = Math.abs(discriminant) > 1e-9 * qb * qb && roots.forall: t =>
        val p = point(t)
        Math.abs(p(2) - c.zMin) > 1e-6 * c.r && Math.abs(p(2) - c.zMax) > 1e-6 * c.r &&
        Math.abs(phi(p) - c.phiMax) > 1e-6 && Math.abs(t) > 1e-9 * c.r
      if clear then
        val expected = roots.find(kept)
        assert(c.sphere.isHit(ray) == expected.isDefined)
        assert(c.sphere.intersect(ray, hit) == expected.isDefined)
        for t <- expected do
          hits += 1
          // The answer is rounded to Float; the textbook formula loses 1e-12/√1e-9
          assert(Math.abs(ray.tMax - t) <= 1e-7 * t + 1e-9 * c.r, s"${ray.tMax} instead of $t")
          ray.tMax = (t * 0.999).toFloat
          assert(!c.sphere.isHit(ray) && !c.sphere.intersect(ray, hit))
    assert(hits > 10000)

  /** The outward gradient of |M⁻¹p| at the world point p, and |M⁻¹p| − r. */
  private def gradient(c: Cut, p: Vec3): (Array[Double], Double) =
    val m = c.toWorld.inverseM
    val q = times(m, doubles(p), 1)
    val length = Math.sqrt(dot(q, q))
    val g = Array.tabulate(3)(i => (m(i) * q(0) + m(4 + i) * q(1) + m(8 + i) * q(2)) / length)
    (g, length - c.r)

  test("hit points are on the surface to their error bound, with normals outwards or reversed"):
    val draws = Draws(2)
    var hits = 0
    for _ <- 0 until 50000 do
      val c = cut(draws)
      shoot(draws, c)
      if c.sphere.intersect(ray, hit) then
        hits += 1
        val p = ray.at(ray.tMax)
        c.sphere.surface(ray, hit, at)
        val (g, off) = gradient(c, at.p)
        val bound = Math.abs(g(0)) * at.pError.x + Math.abs(g(1)) * at.pError.y +
          Math.abs(g(2)) * at.pError.z
        assert(Math.abs(off) <= bound + 1e-14 * c.r, s"${at.p}")
        // Float t and Float p: round-offs of the distances, seen on a slope of up to 16
        assert((p - at.p).length <= 1e-5f * (ray.tMax + p.length))
        val length = Math.sqrt(dot(g, g))
        val sign = if c.reversed then -1 else 1
        val n = Vec3((g(0) / length).toFloat, (g(1) / length).toFloat, (g(2) / length).toFloat)
        // p's rounding moves the normal: far from the origin by 1e-6 radii, stretched by 16
        assert((at.geometricNormal - n * sign.toFloat).length < 1e-4f)
        assert(at.frame.n == at.geometricNormal)
        checkParameters(c): Unit
    assert(hits > 10000)

  private def checkParameters(c: Cut): Assertion =
    val q = times(c.toWorld.inverseM, doubles(at.p), 1)
    def theta(z: Double) = Math.acos(Math.max(-1.0, Math.min(1.0, z / c.r)))
    // p's rounding again, and acos near the poles; the seam at φ = 0 may go either way
    val u = phi(q) / c.phiMax
    val polar = Math.hypot(q(0), q(1)) / c.r
    val slack = 1e-4 / Math.max(polar, 1e-2)
    assert(Math.abs(at.u - u) < slack || (Math.abs(Math.abs(at.u - u) * c.phiMax - TwoPi) < slack))
    val v = (theta(q(2)) - theta(c.zMin)) / (theta(c.zMax) - theta(c.zMin))
    assert(Math.abs(at.v - v) < slack * 20)
    val along = times(c.toWorld.m, Array(-q(1), q(0), 0), 0)
    val s = at.frame.s
    val cosine = dot(along, doubles(s)) / Math.sqrt(dot(along, along))
    assert(polar < 1e-2 || cosine > 0.9999, "s follows ∂p/∂u")
    // Unit vectors after a handful of operations
    assert(abs(s dot at.frame.n) < 1e-6f && abs(s.length - 1f) < 1e-6f)

  test("a sphere a million radii away is hit if the ray passes within its radius"):
    val draws = Draws(3)
    for _ <- 0 until 50000 do
      val r = draws.magnitude(1e-3, 1e3)
      val sphere = Soups.sphere(Transform.Identity, r)
      val o = draws.direction() * (r * draws.magnitude(10, 1e6))
      val d = (draws.direction() * (1.2f * r) - o).normalized
      ray.set(o, d, Float.PositiveInfinity)
      val (a, b) = (doubles(o), doubles(d))
      val cross = Array(
        a(1) * b(2) - a(2) * b(1),
        a(2) * b(0) - a(0) * b(2),
        a(0) * b(1) - a(1) * b(0)
      )
      val passes = Math.sqrt(dot(cross, cross) / dot(b, b)) / r
      // Double resolves the distance to 1e-16 of 1e6 radii
      val clear = Math.abs(passes - 1) > 1e-9
      assert(!clear || sphere.isHit(ray) == passes < 1, passes)

  test("the area is that of the part that is left"):
    val s = Transform.translate(1, 2, 3) * Transform.scale(2, -2, 2).get
    // a few Float operations
    def near(x: Float, y: Double) = assert(Math.abs(x / y - 1) < 1e-6)
    near(Soups.sphere(s, 3f).area, 4 * Math.PI * 36)
    near(Sphere(s, 3f, -1f, 2f, 1f, false).area, 3.0 * 3 * 4)

  test("the bounds hold all points"):
    val draws = Draws(4)
    val out = SurfaceSample()
    for _ <- 0 until 5000 do
      val c = cut(draws)
      val box = c.sphere.bounds
      c.sphere.sample(box.center + draws.direction() * (9 * c.r), draws.unit(), draws.unit(), out)
      assert(box.union(out.p) == box)

  private val parts = Seq(
    "whole, stretched" ->
      Soups.sphere(Transform.rotate(40, 1, 2, 3).get * Transform.scale(1, -2, 0.6).get, 1f),
    "cut" -> Sphere(Transform.rotate(70, 3, 1, 0).get, 1f, -0.8f, 0.3f, 4f, true),
    "whole" -> Soups.sphere(Transform.Identity, 1.5f)
  )

  for ((name, sphere), i) <- parts.zipWithIndex do
    test(s"seen from inside, samples are as dense as the pdf says: $name"):
      val from = Vec3(0.1f, -0.2f, 0.15f)
      val result = SampledShapes.chiSquare(seed = i, sphere, SampledShapes.visible(sphere), from)
      assert(result.accepted(tests = parts.size), result)
      SampledShapes.pdfAgrees(sphere, from, Draws(i))

    test(s"seen from outside, samples integrate what is seen: $name"):
      for from <- Seq(Vec3(2f, 2.5f, -2f), Vec3(-1.5f, 0.5f, 2.2f)) do
        val see = SampledShapes.visible(sphere)
        val draws = Draws(10 + i)
        SampledShapes.integrates(sphere, see, from, draws)(_ => 1.0)
        SampledShapes.integrates(sphere, see, from, draws)(w => 1 + w.x + w.y * w.z)
        SampledShapes.pdfAgrees(sphere, from, draws)

  test("sampled normals are those of the surface: outwards, or reversed"):
    val out = SurfaceSample()
    val draws = Draws(5)
    for from <- Seq(Vec3.Zero, Vec3(9f, 0f, 0f)); reversed <- Seq(false, true) do
      val sphere = Soups.sphere(Transform.scale(-2, 2, 2).get, 1f, reversed)
      for _ <- 0 until 1000 do
        sphere.sample(from, draws.unit(), draws.unit(), out)
        assert(((out.n dot out.p) > 0f) != reversed)
