package candela.stability

import candela.accel.*
import candela.accel.tracing.{Bvh, Grid}
import candela.geometry.{Hit, Ray, ShadingPoint}
import candela.math.*
import candela.shapes.*
import candela.testing.{Draws, Soups}
import Checks.assert

/** Rays that are hard to intersect, and surfaces that are. */
object Intersections extends Group(
      ClosedMeshes.cases ++ LargeAndFar.cases ++ OddRays.cases ++ Seams.cases
    )

class IntersectionsSuite extends GroupSuite(Intersections)

/** Rays close to what is large, and far from what is small: against 60 digits. */
private object LargeAndFar:
  import Exact.*

  val cases: Seq[Case] = Seq(
    Case("a triangle 1e6 wide is met where it is, from a hundredth above", 1000, 10_000_000L)(
      nearLargeTriangle
    ),
    Case("tiny triangles are met from a million sizes away", 2000, 10_000_000L)(farMesh),
    Case("a sphere is met from a million radii away as 60 digits say", 1000, 1_000_000L)(farSphere)
  )

  private def nearLargeTriangle(count: Long): Unit =
    val draws = Draws(3)
    val (ray, hit, at) = (Ray(), Hit(), ShadingPoint())
    var i = 0L
    while i < count do
      val turn = draws.rotation()
      // The origin inside, or on an edge, where another triangle may be the one that is met
      val onEdge = i % 2 == 1
      val third = if onEdge then Vec3(1e6f, 1e6f, 0f) else Vec3(0f, 1e6f, 0f)
      val corners = Seq(Vec3(-1e6f, -1e6f, 0f), Vec3(1e6f, -1e6f, 0f), third).map(turn.point)
      val soup = Soups.of(Seq((corners(0), corners(1), corners(2))))
      val up = turn.vector(Vec3.Z)
      // Above the plane as its Float corners have it, some hundredths off
      val start = turn.point(Vec3(draws.between(-1, 1), draws.between(-1, 1), 1f))
      val down = plane(of(start), of(-up), of(corners(0)), of(corners(1)), of(corners(2)))
      val o = start - up * (down.floatValue - draws.magnitude(1e-3, 1))
      val d = draws.above(-up)
      // As seen at more than 6°, so that what Floats make of the plane shows little
      if Math.abs(d dot up) > 0.1f then
        ray.set(o, d, Float.PositiveInfinity)
        val isMet = TriangleTest.intersect(soup.positions, 0, ray, hit)
        assert(isMet || onEdge, s"from $o along $d")
        if isMet then
          val t = plane(of(o), of(d), of(corners(0)), of(corners(1)), of(corners(2)))
          soup.surface(0, hit, at)
          // To the rounding of a Float point some units from the origin
          val off = (of(at.p) - (of(o) + of(d) * t)).length
          assert(Math.abs(ray.tMax - t.doubleValue) <= 1e-6 * t.doubleValue, s"$t, ${ray.tMax}")
          assert(off <= 2e-6, s"$off from $o along $d"): Unit
      i += 1

  /** The triangles' sides are 1e-3 of the mesh's radius, which is 1e-3 of the distance. */
  private def farMesh(count: Long): Unit =
    val soup = Soups.icosphere(5, Transform.Identity)
    val bvh = Bvh(Primitives(soup, Array.empty))
    val draws = Draws(4)
    val (ray, hit) = (Ray(), Hit())
    var i = 0L
    while i < count do
      val distance = draws.magnitude(1e2, 1e5)
      val o = draws.direction() * distance
      val d = (draws.vec(-0.4f, 0.4f) - o).normalized
      ray.set(o, d, Float.PositiveInfinity)
      // Aimed at the inner half: past it only if the direction's rounding of 1e-7 is half a radius
      assert(bvh.closest(ray, hit), s"from $o along $d")
      // The facets of an icosphere of five levels lie within 1e-3 of the sphere
      val all = sphere(of(o), of(d), of(Vec3.Zero), of(1f))
      for (near, _) <- all do
        assert(Math.abs(ray.tMax - near.doubleValue) <= 0.01 + 4e-7 * distance, s"${ray.tMax}")
      i += 1

  private def farSphere(count: Long): Unit =
    val draws = Draws(5)
    val (ray, hit, at) = (Ray(), Hit(), ShadingPoint())
    var i = 0L
    while i < count do
      val radius = draws.magnitude(1e-4, 1e4)
      val shape = Soups.sphere(Transform.Identity, radius)
      val o = draws.direction() * (radius * draws.magnitude(2, 1e6))
      val d = (draws.vec(-0.6f, 0.6f) * radius - o).normalized
      ray.set(o, d, Float.PositiveInfinity)
      val expected = sphere(of(o), of(d), of(Vec3.Zero), of(radius))
      val found = shape.intersect(ray, hit)
      for (near, far) <- expected do
        // All but the rays that graze it, by 1e-6 of its radius
        if (far -~ near).doubleValue > 2e-3 * radius then
          assert(found, s"from $o along $d")
          shape.surface(ray, hit, at)
          val off = (of(at.p) - (of(o) + of(d) * near)).length
          assert(off <= 1e-6 * radius, s"$off, radius $radius, from $o along $d"): Unit
      if expected.isEmpty then
        val closest = ((of(o) cross of(d)).length / of(d).length) / radius
        assert(!found || closest < 1 + 1e-9, s"$closest radii: from $o along $d"): Unit
      i += 1

/** Rays with zeros, infinities and NaN, and surfaces without thickness or area. */
private object OddRays:
  val cases: Seq[Case] = Seq(
    Case("no number, infinity or zero in a ray does harm", 3000, 1_000_000L)(oddRays),
    Case("triangles without an area have normals and points that are numbers", 5000, 10_000_000L)(
      degenerate
    ),
    Case("triangles that are there twice are met once, where one of them is", 5000, 10_000_000L)(
      duplicates
    ),
    Case("rays along the axes meet boxes without thickness", 2000, 1_000_000L)(flatBoxes)
  )

  private val odd = Seq(0f, -0f, 1f, -1f, Float.NaN, Float.PositiveInfinity,
    Float.NegativeInfinity, 1e-45f, -1e-38f, 3e38f, -1e30f, 1e-20f)

  private def oddRays(count: Long): Unit =
    val draws = Draws(6)
    def number() = if draws.below(3) == 0 then draws.between(-1, 1) else odd(draws.below(odd.size))
    val near = Soups.randomTriangles(draws, 200, 0.3f)(draws.vec(-1, 1))
    val solids = Soups.shapes(draws, 20, 0.5f)(draws.vec(-1, 1)) ++
      Seq.tabulate(8)(k => Quadrics.random(draws, k, 1f).placed(Transform.Identity)) ++
      Seq.fill(4)(BilinearPatches.of(BilinearPatches.corners(draws)))
    val all = Primitives(Soups.of(near), solids.toArray)
    val (bvh, grid) = (Bvh(all), Grid(all))
    val (ray, hit) = (Ray(), Hit())
    var i = 0L
    while i < count do
      val o = Vec3(number(), number(), number())
      val d = Vec3(number(), number(), number())
      for a <- Seq(bvh, grid) do
        ray.set(o, d, Float.PositiveInfinity)
        if a.closest(ray, hit) then
          assert(ray.tMax >= 0f && !ray.tMax.isNaN, s"${ray.tMax} from $o along $d"): Unit
        ray.set(o, d, Float.PositiveInfinity)
        a.isOccluded(ray, hit): Unit
      i += 1

  /** Corners on a line, or twice the same; with rays aimed right at them. */
  private def degenerate(count: Long): Unit =
    val draws = Draws(7)
    val (ray, hit, at) = (Ray(), Hit(), ShadingPoint())
    var i = 0L
    while i < count do
      val (a, along) = (draws.vec(-3, 3), draws.direction())
      val b = if i % 4 == 0 then a else a + along * draws.between(-1, 1)
      val c = if i % 4 == 1 then b else a + along * draws.between(-1, 1)
      val soup = Soups.of(Seq((a, b, c)))
      val o = draws.vec(-3, 3)
      val t = draws.unit()
      ray.set(o, a * (1f - t) + c * t - o, Float.PositiveInfinity)
      if TriangleTest.intersect(soup.positions, 0, ray, hit) then
        soup.surface(0, hit, at)
        val n = at.geometricNormal
        assert(at.p.isFinite && at.pError.isFinite, s"${at.p} of $a $b $c")
        assert(Math.abs(n.length - 1f) < 1e-5f, s"$n of $a $b $c")
        assert(Math.abs(at.frame.s.length - 1f) < 1e-5f, s"${at.frame.s} of $a $b $c"): Unit
      i += 1

  private def duplicates(count: Long): Unit =
    val draws = Draws(9)
    val (ray, hit, other) = (Ray(), Hit(), Hit())
    var i = 0L
    while i < count do
      val one = Soups.randomTriangles(draws, 1, 1f)(draws.vec(-1, 1)).head
      val alone = Bvh(Primitives(Soups.of(Seq(one)), Array.empty))
      val all = Primitives(Soups.of(Seq(one, one, one)), Array.empty)
      val o = draws.vec(-3, 3)
      val d = draws.vec(-1, 1) - o
      ray.set(o, d, Float.PositiveInfinity)
      val isMet = alone.closest(ray, hit)
      val t = ray.tMax
      for a <- Seq(Bvh(all), Grid(all)) do
        ray.set(o, d, Float.PositiveInfinity)
        assert(a.closest(ray, other) == isMet && ray.tMax == t, s"$t, ${ray.tMax}: $o along $d")
      i += 1

  private def flatBoxes(count: Long): Unit =
    val draws = Draws(8)
    val (ray, hit) = (Ray(), Hit())
    var i = 0L
    while i < count do
      val axis = (i % 3).toInt
      val size = draws.magnitude(1e-6, 1e6)
      val height = draws.between(-9, 9) * size
      def at(a: Float, b: Float, h: Float) =
        val p = new Array[Float](3)
        p(axis) = h
        p((axis + 1) % 3) = a * size
        p((axis + 2) % 3) = b * size
        Vec3(p(0), p(1), p(2))
      val (p, q, r, s) =
        (at(-1, -1, height), at(1, -1, height), at(1, 1, height), at(-1, 1, height))
      val all = Primitives(Soups.of(Seq((p, q, r), (p, r, s))), Array.empty)
      val zero = if draws.coin() then 0f else -0f
      val side = if draws.coin() then 1f else -1f
      val o = at(draws.between(-1, 1), draws.between(-1, 1), height - side * size)
      val d = Array(zero, zero, zero)
      d(axis) = side
      for a <- Seq(Bvh(all), Grid(all)) do
        ray.set(o, Vec3(d(0), d(1), d(2)), Float.PositiveInfinity)
        assert(a.closest(ray, hit), s"from $o along $axis")
        val exact = Math.abs(height.toDouble - o(axis))
        assert(Math.abs(ray.tMax - exact) <= 1e-6 * exact, s"${ray.tMax} not $exact"): Unit
      i += 1
