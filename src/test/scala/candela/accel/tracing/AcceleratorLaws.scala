package candela.accel.tracing

import candela.accel.{Accelerator, AcceleratorScenes, BruteForce, Primitives}
import candela.geometry.{Bounds3, Hit, Ray}
import candela.math.*
import candela.testing.{Draws, RandomLaws, Soups}

/** What every accelerator must obey: it finds what testing everything finds. */
abstract class AcceleratorLaws(make: Primitives => Accelerator) extends RandomLaws:

  /** A ray to be: origin, direction and end. */
  private type Line = (Vec3, Vec3, Float)

  private val box0 = Bounds3(Vec3(-1f, -1f, -1f), Vec3(1f, 1f, 1f))

  private def inside(draws: Draws, box: Bounds3, by: Float = 1f): Vec3 =
    val v = draws.vec(-0.5f * by, 0.5f * by)
    box.center + Vec3(v.x * box.extent.x, v.y * box.extent.y, v.z * box.extent.z)

  private def signedZeros(draws: Draws, d: Vec3): Vec3 =
    def zero() = if draws.coin() then 0f else -0f
    val keep = draws.below(3) // of the other two one or none stays
    val also = draws.below(4)
    def part(k: Int) = if k == keep || k == also then d(k) else zero()
    Vec3(part(0), part(1), part(2))

  /** A coordinate for each axis that is one of the primitives' box faces. */
  private def onFaces(draws: Draws, boxes: Array[Float]): Vec3 =
    def face(k: Int) =
      boxes(6 * draws.below(boxes.length / 6) + k + (if draws.coin() then 3 else 0))
    Vec3(face(0), face(1), face(2))

  private def line(draws: Draws, primitives: Primitives, boxes: Array[Float]): Line =
    val box = if primitives.count == 0 then box0 else Accelerator.union(boxes)
    val size = Math.max(box.radius, 1e-3f)
    def free() = inside(draws, box, by = 3f)
    val (o, d) = draws.below(7) match
      case 0 => (free(), draws.direction())
      case 1 =>
        val o = free()
        (o, (inside(draws, box) - o).normalized)
      case 2 => // along an axis or in a plane of two
        val target = inside(draws, box)
        val d = signedZeros(draws, draws.direction()).normalized
        (target - d * (2f * size * draws.unit()), d)
      case 3 if primitives.count > 0 => // starts on planes of boxes
        val o = onFaces(draws, boxes)
        (o, if draws.coin() then signedZeros(draws, draws.direction()) else draws.direction())
      case 4 if primitives.count > 0 => // towards corners of boxes, of any length
        val o = free()
        (o, onFaces(draws, boxes) - o)
      case 5 if primitives.soup.count > 0 => // towards edges of triangles
        val (o, triangle, t) = (free(), draws.below(primitives.soup.count), draws.unit())
        val (a, b) = (primitives.soup.vertex(triangle, 0), primitives.soup.vertex(triangle, 2))
        (o, (a * (1f - t) + b * t - o).normalized)
      case _ => // from afar
        val o = box.center + draws.direction() * (30f * size)
        (o, (inside(draws, box) - o).normalized)
    val end =
      if draws.coin() then Float.PositiveInfinity else size * draws.magnitude(1e-3, 10) / d.length
    (o, d, end)

  for (name, primitives) <- AcceleratorScenes.all do
    law(s"finds what testing everything finds: $name"): plan =>
      val reference = BruteForce(primitives)
      val accelerator = make(primitives)
      val boxes = primitives.bounds
      val draws = Draws(plan.seed(name.hashCode))
      val (ray, expectedRay) = (Ray(), Ray())
      val (hit, expected) = (Hit(), Hit())
      // Testing 10000 primitives in turn takes its time
      val rays = plan.count(if primitives.count > 1000 then 1000 else 4000)
      var hits = 0
      for i <- 0 until rays do
        val (o, d, end) = line(draws, primitives, boxes)
        def at = s"ray $i from $o along $d to $end"
        ray.time = draws.unit()
        expectedRay.time = ray.time
        ray.set(o, d, end)
        expectedRay.set(o, d, end)
        val found = accelerator.closest(ray, hit)
        val isThere = reference.closest(expectedRay, expected)
        if isThere then hits += 1
        assert(found == (hit.primitive >= 0), at)
        if hit.primitive == expected.primitive && found then
          val isTriangle = hit.primitive < primitives.soup.count
          val isInstance = hit.primitive >= primitives.count - primitives.instances.count
          val isSame = (!isTriangle || (hit.u == expected.u && hit.v == expected.v)) &&
            (!isInstance || hit.inner == expected.inner)
          assert(isSame && ray.tMax == expectedRay.tMax, at): Unit
        else if ray.tMax != expectedRay.tMax then
          // Which of two is closer is decided to the rounding of their distances, a few round-offs
          // of the way to the primitives' far ends; the boxes' slack is of that order too
          val slack = 1e-5f * Math.max(ray.tMax, expectedRay.tMax)
          assert(
            abs(ray.tMax - expectedRay.tMax) <= slack,
            s"$at: ${hit.primitive} at ${ray.tMax}, " +
              s"not ${expected.primitive} at ${expectedRay.tMax}"
          ): Unit
        else
          def both = s"${hit.primitive}, not ${expected.primitive}, at one distance"
          assert(!found, s"$at: $both"): Unit
        ray.set(o, d, end)
        assert(accelerator.isOccluded(ray, hit) == found, at)
        assert(ray.tMax == end, "asking for occlusion leaves the ray as it is")
      // The rays are worth something
      assert(primitives.count == 0 || hits > rays / 50, s"$hits hits"): Unit

  test("bounds are those of all primitives"):
    for (name, primitives) <- AcceleratorScenes.all do
      assert(make(primitives).bounds == BruteForce(primitives).bounds, name)

  private def placements(draws: Draws): Seq[(String, Transform)] =
    Seq(
      "at the origin" -> Transform.Identity,
      "turned and stretched" ->
        draws.rotation() * Transform.scale(3, 1, 0.5).get * draws.rotation(),
      "moved away" -> Transform.translate(300, -70, 1000) * draws.rotation(),
      "tiny" -> Transform.scale(1e-3, 1e-3, 1e-3).get,
      "huge" -> Transform.scale(1e4, 1e4, 1e4).get
    )

  for (name, toWorld) <- placements(Draws(7)) do
    law(s"no ray leaves a closed mesh: $name"): plan =>
      val soup = Soups.icosphere(4, toWorld)
      val accelerator = make(Primitives(soup, Array.empty))
      val draws = Draws(plan.seed(name.hashCode))
      val (ray, hit) = (Ray(), Hit())
      for i <- 0 until plan.count(40000) do
        // All placements keep the ball of half the smallest stretch inside
        val o = toWorld.point(if i % 50 == 0 then Vec3.Zero else draws.direction() * 0.6f)
        val triangle = draws.below(soup.count)
        val (a, b) = (soup.vertex(triangle, draws.below(3)), soup.vertex(triangle, draws.below(3)))
        val target = i % 3 match
          case 0 => a
          case 1 => a * 0.5f + b * 0.5f
          case _ =>
            val t = draws.unit()
            a * (1f - t) + b * t
        val d = if i % 4 == 3 then draws.direction() else target - o
        ray.set(o, if i % 4 == 1 then d.normalized else d, Float.PositiveInfinity)
        assert(accelerator.closest(ray, hit), s"from $o along $d")
        ray.set(o, d, Float.PositiveInfinity)
        assert(accelerator.isOccluded(ray, hit), s"from $o along $d")

class BvhSuite extends AcceleratorLaws(Bvh(_)):

  test("a leaf may hold one primitive, or all"):
    val (_, primitives) = AcceleratorScenes.all.find(_._1 == "uniform").get
    val draws = Draws(3)
    val trees = Seq(Bvh(primitives, maxLeaf = 1), Bvh(primitives, maxLeaf = primitives.count))
    val (ray, hit) = (Ray(), Hit())
    val reference = Bvh(primitives)
    for _ <- 0 until 2000 do
      val (o, d) = (draws.vec(-2, 2), draws.direction())
      ray.set(o, d, Float.PositiveInfinity)
      reference.closest(ray, hit): Unit
      val expected = hit.primitive
      for tree <- trees do
        ray.set(o, d, Float.PositiveInfinity)
        assert(tree.closest(ray, hit) == (expected >= 0) && hit.primitive == expected)

class ScalarWideSuite extends AcceleratorLaws(Hierarchies.scalar(_))
class UnsplitSuite extends AcceleratorLaws(Hierarchies.scalar(_, unsplit = Hierarchies.Unsplit))
class CarefulSuite extends AcceleratorLaws(Hierarchies.careful(_))

/** The best that this JVM has. */
class HierarchySuite
    extends AcceleratorLaws(p =>
      if Hierarchies.hasVectors then Hierarchies.vector(p) else Hierarchies.of(p)
    ):

  test("SIMD takes many samples, or a mesh and some"):
    val cases = Seq(
      (15, Long.MaxValue, false),
      (16, 1_500_000L, true),
      (999, 1_499_999L, false),
      (1000, 500_000L, true),
      (1_000_000, 499_999L, false)
    )
    for (primitives, samples, expected) <- cases do
      assert(Hierarchies.isWorthIt(primitives, samples) == expected, s"$primitives, $samples")

  test("many primitives for few samples are not sorted to the last"):
    val cases = Seq(
      (1_000_000, 49_152L, true),
      (2_000_000, 100_000L, false),
      (2_000_020, 100_000L, true),
      (Int.MaxValue, Long.MaxValue, false),
      (3, 0L, false)
    )
    for (primitives, samples, expected) <- cases do
      assert(Hierarchies.isBrief(primitives, samples) == expected, s"$primitives, $samples")

class GridSuite extends AcceleratorLaws(Grid(_)):

  test("its size follows the number of primitives"):
    val (_, primitives) = AcceleratorScenes.all.find(_._1 == "at voxel faces").get
    assert(Grid(primitives).describe.startsWith("grid: 216 primitives in 18×18×18 voxels"))
