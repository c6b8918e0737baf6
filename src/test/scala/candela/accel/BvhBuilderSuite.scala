package candela.accel

import org.scalatest.funsuite.AnyFunSuite

import candela.base.{loop, Parallel}
import candela.geometry.{Bounds3, Hit, Ray}
import candela.math.*
import candela.render.Crew
import candela.testing.{Draws, Soups}

class BvhBuilderSuite extends AnyFunSuite:

  private def bits(x: Float): Int = java.lang.Float.floatToRawIntBits(x)

  for (name, primitives) <- AcceleratorScenes.all; maxLeaf <- Seq(1, 4) do
    test(s"each primitive is in one leaf, inside all boxes above: $name, leaves to $maxLeaf"):
      val boxes = primitives.bounds
      val built = BvhBuilder(boxes, maxLeaf)
      val seen = new Array[Int](primitives.count)

      def visit(code: Int, size: Int, depth: Int, above: List[Array[Float]]): Unit =
        // What the walk's stack has room for
        assert(depth <= 128)
        if code < 0 then
          assert(primitives.count == 0 || (size >= 1 && size <= maxLeaf))
          for slot <- ~code until ~code + size do
            val i = built.order(slot)
            seen(i) += 1
            for box <- above; k <- 0 until 3 do
              assert(box(k) <= boxes(6 * i + k) && box(3 + k) >= boxes(6 * i + 3 + k))
        else
          for side <- 0 until 2 do
            val at = code + 6 * side
            visit(
              bits(built.nodes(code + 12 + side)),
              bits(built.nodes(code + 14 + side)),
              depth + 1,
              built.nodes.slice(at, at + 6) :: above
            )

      visit(built.root, built.rootCount, 0, Nil)
      assert(seen.forall(_ == 1))

  test("primitives that all lie at one point are halved into leaves"):
    val built = BvhBuilder(Array.fill(6 * 1000)(2f), maxLeaf = 4)
    assert(built.order.sorted.sameElements(Array.range(0, 1000)))
    assert(built.nodeCount <= 511) // 1000 in leaves of at most 4 by halving: 256 or 512 leaves

  test("centroids a denormal number apart are no worse than equal ones"):
    val boxes = Array.tabulate(6 * 100)(i => (i / 6 % 2) * 1e-44f)
    assert(BvhBuilder(boxes, maxLeaf = 4).order.distinct.length == 100)

  /** A torus with bumps: 2·`sides`² triangles in the order of a mesh. */
  private def torus(sides: Int): Primitives =
    val positions = (for v <- 0 until sides; u <- 0 until sides yield
      val (a, b) = (2 * Math.PI * u / sides, 2 * Math.PI * v / sides)
      val r = 0.4 + 0.05 * Math.sin(9 * a) * Math.sin(13 * b)
      val out = 1 + r * Math.cos(b)
      Seq(out * Math.cos(a), out * Math.sin(a), r * Math.sin(b)).map(_.toFloat)
    ).flatten.toArray
    val indices = (for v <- 0 until sides; u <- 0 until sides yield
      def at(i: Int, j: Int) = (v + j) % sides * sides + (u + i) % sides
      Seq(at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1))
    ).flatten.toArray
    Primitives(Soups.indexed(positions, indices), Array.empty)

  private def boxesOf(primitives: Primitives): IndexedSeq[Bounds3] =
    primitives.bounds.grouped(6).toIndexedSeq.map: b =>
      Bounds3(Vec3(b(0), b(1), b(2)), Vec3(b(3), b(4), b(5)))

  test(
    "a mesh's tree, and those of other scenes on average, cost no more than the obvious builder's"
  ):
    def ratio(primitives: Primitives): Double =
      val boxes = boxesOf(primitives)
      val built = SlowTree.of(BvhBuilder.of(primitives, LeafSize.single(4), Parallel.Alone))
      val slow = SlowTree.build(boxes, maxLeaf = 4)
      assert(built.primitivesInside.sorted == slow.primitivesInside.sorted)
      built.cost / slow.cost
    assert(ratio(torus(28)) < 1.02)
    val ratios =
      AcceleratorScenes.all.map(_._2).filter(p => p.count > 1 && p.count < 400).map(ratio)
    assert(ratios.sum / ratios.size < 1.01, ratios)
    assert(ratios.max < 1.1, ratios)

  test("records hold the boxes of all kinds of primitives exactly"):
    for (name, primitives) <- AcceleratorScenes.all do
      val records = primitives.records(Parallel.Alone)
      val bounds = primitives.bounds
      val read = new Array[Float](6)
      loop(primitives.count): i =>
        BoxRecord.read(records, BoxRecord.Ints * i, read, 0)
        assert(records(BoxRecord.Ints * i + BoxRecord.Number) == i)
        val same = read.sameElements(bounds.slice(6 * i, 6 * i + 6))
        if !same then fail(s"$name, $i")

  test("encoded numbers are in the order of those that they stand for"):
    val draws = Draws(5)
    val ends = Seq(0f, Float.MaxValue, Float.PositiveInfinity, Float.MinPositiveValue)
    val numbers = ends ++ Seq.fill(200)(draws.magnitude(1e-40, 1e38))
    val sorted = (numbers ++ numbers.map(-_)).sorted
    assert(sorted.map(BoxRecord.encode(_)) == sorted.map(BoxRecord.encode(_)).sorted)
    assert(sorted.forall(x => BoxRecord.decode(BoxRecord.encode(x)).equals(x)))
    assert(BoxRecord.encode(Float.NegativeInfinity) == BoxRecord.Least)

  /** Several threads' work by one, the last first. */
  private object Backwards extends Parallel:
    def threads: Int = 3
    def each(count: Int)(task: Int => Unit): Unit = loop(count)(i => task(count - 1 - i))

  test("the tree is the same for any number of threads"):
    val draws = Draws(9)
    def centre = if draws.coin() then draws.vec(-1, 1) else draws.vec(0, 0.1f)
    val boxes = Array.fill(50_000):
      val (c, size) = (centre, draws.magnitude(1e-4, 1e-2))
      Array(c.x - size, c.y - size, c.z, c.x + size, c.y + size, c.z + size)
    val mesh = torus(140).bounds
    for all <- Seq(boxes.flatten, mesh) do
      def build(parallel: Parallel) = BvhBuilder(all, maxLeaf = 4, parallel)
      val alone = build(Parallel.Alone)
      for parallel <- Seq(Crew(2), Crew(7), Backwards) do
        val other = build(parallel)
        assert(other.order.sameElements(alone.order))
        assert(other.nodes.map(bits).sameElements(alone.nodes.map(bits)))
        assert((other.root, other.rootCount, other.bounds) == (
          alone.root,
          alone.rootCount,
          alone.bounds
        ))

  test("the wide tree is the same for any number of threads"):
    val draws = Draws(10)
    val spheres = Soups.shapes(draws, 12_000, 1e-3f)(draws.vec(-1, 1)).toArray
    val mixed = Primitives(torus(115).soup, spheres)
    for (primitives, width, lanes) <- Seq((torus(150), 4, 4), (mixed, 16, 8)) do
      def build(parallel: Parallel) = WideTree.of(primitives, width, lanes, 4, parallel)
      val alone = build(Parallel.Alone)
      assert(alone.count > 32768)
      for parallel <- Seq(Crew(3), Backwards) do
        val other = build(parallel)
        assert(other.root == alone.root)
        assert(other.nodes.map(bits).sameElements(alone.nodes.map(bits)))
        assert(other.blocks.map(bits).sameElements(alone.blocks.map(bits)))
      val wide = Hierarchies.scalar(primitives, width, Crew(3))
      val (ray, hit) = (Ray(), Hit())
      val reference = Bvh(primitives)
      loop(1000): _ =>
        val (from, to) = (draws.vec(-2, 2), draws.vec(-1, 1))
        ray.set(from, to - from, Float.PositiveInfinity)
        val found = reference.closest(ray, hit)
        val (primitive, t) = (hit.primitive, ray.tMax)
        ray.set(from, to - from, Float.PositiveInfinity)
        assert(wide.closest(ray, hit) == found && hit.primitive == primitive && ray.tMax == t): Unit

  test("infinite and undefined boxes do no harm"):
    for odd <- Seq(Float.PositiveInfinity, Float.NegativeInfinity, Float.NaN, Float.MaxValue) do
      val draws = Draws(3)
      val boxes = Array.fill(200)(draws.vec(-1, 1)).flatMap: p =>
        Array(p.x, p.y, p.z, p.x + 0.1f, if draws.below(9) == 0 then odd else p.y + 0.1f, p.z)
      assert(BvhBuilder(boxes, maxLeaf = 4).order.sorted.sameElements(Array.range(0, 200)))
