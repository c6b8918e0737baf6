package candela.shapes

import org.scalatest.funsuite.AnyFunSuite

import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.testing.Draws

class TriangleTestSuite extends AnyFunSuite:
  private val ray = Ray()
  private val hit = Hit()

  private def corners(a: Vec3, b: Vec3, c: Vec3): Array[Float] =
    Seq(a, b, c).flatMap(p => Seq(p.x, p.y, p.z)).toArray

  private def meets(v: Array[Float], o: Vec3, d: Vec3, end: Float = Float.PositiveInfinity) =
    ray.set(o, d, end)
    val occluded = TriangleTest.isHit(v, 0, ray, hit)
    assert(ray.tMax == end)
    val found = TriangleTest.intersect(v, 0, ray, hit)
    assert(found == occluded)
    found

  /** A random triangle, and a point in it of these barycentric coordinates. */
  private final class Triangle(draws: Draws):
    private val (a, b, c) = (draws.vec(-1, 1), draws.vec(-1, 1), draws.vec(-1, 1))
    val (b1, b2) = (draws.between(0.01f, 0.49f), draws.between(0.01f, 0.49f))
    val point: Vec3 = a * (1 - b1 - b2) + b * b1 + c * b2
    val n: Vec3 = (b - a) cross (c - a)
    val v: Array[Float] = corners(a, b, c)

  test("a camera's ray does not hit the triangle in whose plane it starts, but for rounding"):
    val draws = Draws(7)
    for _ <- 0 until 10000 do
      val triangle = Triangle(draws)
      import triangle.{n, point, v}
      if n.length > 0.01f then
        val d = draws.vec(-1, 1).normalized
        ray.set(point, d, Float.PositiveInfinity)
        ray.isPrimary = true
        assert(!TriangleTest.isHit(v, 0, ray, hit) && !TriangleTest.intersect(v, 0, ray, hit))
        // Ten times the rounding away, it does
        val aside = point + n.normalized * 1e-5f
        ray.set(aside, (point - aside).normalized, Float.PositiveInfinity)
        ray.isPrimary = true
        assert(TriangleTest.isHit(v, 0, ray, hit)): Unit

  test("a camera close above a level floor sees it, however large it is"):
    val floor = corners(Vec3(-1e6f, 0, -1e6f), Vec3(1e6f, 0, -1e6f), Vec3(0, 0, 1e6f))
    ray.set(Vec3(3, 1e-6f, 5), Vec3(0.6f, -0.8f, 0), Float.PositiveInfinity)
    ray.isPrimary = true
    assert(TriangleTest.intersect(floor, 0, ray, hit))

  test("distance and weights are those of the point that was aimed at"):
    val draws = Draws(1)
    for _ <- 0 until 100000 do
      val triangle = Triangle(draws)
      import triangle.n
      val o = draws.vec(-3, 3)
      val d = triangle.point - o
      // Seen at more than 6° and wide enough, an error of a few round-offs of the coordinates stays
      // below 1e-4 of the sides
      if n.length > 0.1f && (n.normalized absDot d) > 0.1f * d.length then
        assert(meets(triangle.v, o, d))
        val off = Math.max(Math.abs(hit.u - triangle.b1), Math.abs(hit.v - triangle.b2))
        assert(abs(ray.tMax - 1f) < 1e-4f && off < 1e-4): Unit

  test("both sides are hit alike"):
    val v = corners(Vec3.Zero, Vec3.X, Vec3.Y)
    for z <- Seq(2f, -2f) do
      assert(meets(v, Vec3(0.25f, 0.5f, z), Vec3(0f, 0f, -z)))
      assert(ray.tMax == 1f && hit.u == 0.25f && hit.v == 0.5f)

  test("nothing behind the origin, at it, or beyond the end is hit"):
    val v = corners(Vec3.Zero, Vec3.X, Vec3.Y)
    def from(z: Float, end: Float = Float.PositiveInfinity) =
      meets(v, Vec3(0.25f, 0.25f, z), Vec3(0f, 0f, 1f), end)
    assert(!from(1f) && !from(0f) && from(-1f))
    assert(!from(-1f, end = 0.999f) && from(-1f, end = 1.001f))

  test("a ray in the plane of the triangle misses it"):
    val draws = Draws(2)
    val v = corners(Vec3.Zero, Vec3.X, Vec3.Y)
    for _ <- 0 until 1000 do
      val d = Vec3(draws.between(-1, 1), draws.between(-1, 1), if draws.coin() then 0f else -0f)
      assert(!meets(v, Vec3(draws.between(-2, 2), draws.between(-2, 2), 0f), d))

  test("a ray through the common edge or corner of neighbours meets one of them"):
    val draws = Draws(3)
    for _ <- 0 until 20000 do
      // A fan of four around the corner m
      val size = draws.magnitude(1e-3, 1e3)
      val m = draws.vec(-size, size)
      val (a, b) = (m + draws.vec(-1, 1) * size, m + draws.vec(-1, 1) * size)
      val rim = Seq(a, b, m * 2f - a, m * 2f - b)
      val fan = (0 until 4).map(i => corners(m, rim(i), rim((i + 1) % 4)))
      val n = ((a - m) cross (b - m)).normalized
      val o = m + (n + draws.vec(-0.3f, 0.3f)) * size
      val t = draws.between(0, 0.9f)
      val target = if draws.coin() then m else m * (1 - t) + rim(draws.below(4)) * t
      assert(fan.exists(v => meets(v, o, target - o)), s"$o $target")

  test("a triangle without area is never hit"):
    val draws = Draws(4)
    for _ <- 0 until 100000 do
      val (a, d) = (draws.vec(-1, 1), draws.vec(-1, 1))
      val other = if draws.coin() then a else a + d * draws.between(-2, 2)
      val target = a + d * draws.unit()
      val o = draws.vec(-3, 3)
      val v = corners(a, a + d, other)
      val hasNoArea = ((a + d - a) cross (other - a)).isZero
      assert(!hasNoArea || !meets(v, o, target - o))

  test("conditions by bits agree with comparisons, also of zeros, infinities and NaN"):
    val special =
      Seq(0f, -0f, 1f, -1f, Float.MinPositiveValue, -Float.MinPositiveValue, Float.NaN) ++
        Seq(Float.MaxValue, -Float.MaxValue, Float.PositiveInfinity, Float.NegativeInfinity)
    val nans = Seq(0x7fc00000, 0xffc00000, 0x7f800001).map(java.lang.Float.intBitsToFloat)
    for a <- special ++ nans; b <- special ++ nans; c <- special ++ nans do
      val all = Seq(a, b, c)
      assert(TriangleTest.isAnyZero(a, b, c) == all.contains(0f), s"$all")
      val mixed = all.exists(_ < 0f) && all.exists(_ > 0f)
      assert(TriangleTest.areMixed(a, b, c) == mixed, s"$all"): Unit

  test("of two hits the closer one precedes, then the one of the lower number"):
    val (near, far) = (1f, Math.nextUp(1f))
    for
      t <- Seq(near, far, Float.MinPositiveValue)
      end <- Seq(near, far, Float.MaxValue, Float.PositiveInfinity, Float.NaN)
      number <- Seq(0, 1, 7, Int.MaxValue)
      other <- Seq(-1, 0, 1, 7, Int.MaxValue)
    do
      ray.set(Vec3.Zero, Vec3.X, end)
      hit.primitive = other
      val precedes = t < end || (t == end && number < other)
      assert(
        TriangleTest.isCloser(t, number, ray, hit) == precedes,
        s"$t $number $end $other"
      ): Unit
