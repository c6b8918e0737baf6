package candela.accel.building

import candela.base.loop
import candela.concurrency.Parallel
import org.scalatest.funsuite.AnyFunSuite

import candela.accel.{AcceleratorScenes, BinaryTree, Primitives}
import candela.geometry.Bounds3
import candela.math.*
import candela.render.ThreadPool
import candela.testing.Draws

class BvhBuilderSuite extends AnyFunSuite:

  /** @param boxes six Floats a primitive */
  private def build(
      boxes: Array[Float],
      maxLeaf: Int,
      parallel: Parallel = Parallel.Alone
  ): BinaryTree =
    val records = new Array[Int](BoxRecord.Ints * (boxes.length / 6))
    for (b, i) <- boxes.grouped(6).zipWithIndex do
      BoxRecord.write(records, i * BoxRecord.Ints, i, b(0), b(1), b(2), b(3), b(4), b(5))
    BvhBuilder.ofRecords(records, LeafSize.single(maxLeaf), parallel)

  private def bits(x: Float): Int = java.lang.Float.floatToRawIntBits(x)

  for (name, primitives) <- AcceleratorScenes.all; maxLeaf <- Seq(1, 4) do
    test(s"each primitive is in one leaf, inside all boxes above: $name, leaves to $maxLeaf"):
      val boxes = primitives.bounds
      val built = build(boxes, maxLeaf)
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
    val built = build(Array.fill(6 * 1000)(2f), maxLeaf = 4)
    assert(built.order.sorted.sameElements(Array.range(0, 1000)))
    assert(built.nodeCount <= 511) // 1000 in leaves of at most 4 by halving: 256 or 512 leaves

  test("centroids a denormal number apart are no worse than equal ones"):
    val boxes = Array.tabulate(6 * 100)(i => (i / 6 % 2) * 1e-44f)
    assert(build(boxes, maxLeaf = 4).order.distinct.length == 100)

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
    assert(ratio(AcceleratorScenes.torus(28)) < 1.02)
    val ratios =
      AcceleratorScenes.all.map(_._2).filter(p => p.count > 1 && p.count < 400).map(ratio)
    assert(ratios.sum / ratios.size < 1.01, ratios)
    assert(ratios.max < 1.1, ratios)

  test("records hold the boxes of all kinds of primitives exactly"):
    for (name, primitives) <- AcceleratorScenes.all do
      val records = BoxRecord.ofAll(primitives, Parallel.Alone)
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
    assert(BoxRecord.encode(Float.NegativeInfinity) == BoxRecord.MinusInfinity)

  test("the tree is the same for any number of threads"):
    val draws = Draws(9)
    def centre = if draws.coin() then draws.vec(-1, 1) else draws.vec(0, 0.1f)
    val boxes = Array.fill(50_000):
      val (c, size) = (centre, draws.magnitude(1e-4, 1e-2))
      Array(c.x - size, c.y - size, c.z, c.x + size, c.y + size, c.z + size)
    val mesh = AcceleratorScenes.torus(140).bounds
    for all <- Seq(boxes.flatten, mesh) do
      val alone = build(all, maxLeaf = 4)
      for parallel <- Seq(ThreadPool(2), ThreadPool(7), Backwards) do
        val other = build(all, maxLeaf = 4, parallel)
        assert(other.order.sameElements(alone.order))
        assert(other.nodes.map(bits).sameElements(alone.nodes.map(bits)))
        assert((other.root, other.rootCount, other.bounds) == (
          alone.root,
          alone.rootCount,
          alone.bounds
        ))

  test("infinite and undefined boxes do no harm"):
    for odd <- Seq(Float.PositiveInfinity, Float.NegativeInfinity, Float.NaN, Float.MaxValue) do
      val draws = Draws(3)
      val boxes = Array.fill(200)(draws.vec(-1, 1)).flatMap: p =>
        Array(p.x, p.y, p.z, p.x + 0.1f, if draws.below(9) == 0 then odd else p.y + 0.1f, p.z)
      assert(build(boxes, maxLeaf = 4).order.sorted.sameElements(Array.range(0, 200)))

/** Several threads' work by one, the last first. */
private[building] object Backwards extends Parallel:
  def threads: Int = 3
  def forEach(count: Int)(task: Int => Unit): Unit = loop(count)(i => task(count - 1 - i))
  def worksAside: Boolean = false
  def aside(name: String)(task: => Unit): Unit = ()
