package candela.accel

import candela.base.{loop, Parallel}
import candela.geometry.Bounds3
import candela.math.Vec3

/** A finished hierarchy of two children a node: see [[Bvh]] for the layout of `nodes`.
  *
  * @param order     the primitives as the leaves hold them
  * @param root      encoded as a child is
  * @param rootCount how many primitives are in the root, if it is a leaf
  * @param bounds    the box around all primitives
  */
private[accel] final class BvhBuilder private (
    val order: Array[Int],
    val nodes: Array[Float],
    val root: Int,
    val rootCount: Int,
    val bounds: Bounds3
):
  def nodeCount: Int = nodes.length / BvhBuilder.NodeFloats

  /** Subtrees of at most so many primitives are one thread's work. */
  def partSize: Int = BvhBuilder.partSize(order.length)

  private def bits(at: Int): Int = java.lang.Float.floatToRawIntBits(nodes(at))
  def child(node: Int, side: Int): Int = bits(node + 12 + side)
  def leafSize(node: Int, side: Int): Int = bits(node + 14 + side)

  /** Slots of `order` from here on are in the subtree. */
  def firstSlot(node: Int): Int =
    val left = child(node, 0)
    if left < 0 then ~left else firstSlot(left)

  def endSlot(node: Int): Int =
    val right = child(node, 1)
    if right < 0 then ~right + leafSize(node, 1) else endSlot(right)

  /** How many primitives are in the subtree. */
  def count(node: Int): Int = endSlot(node) - firstSlot(node)

  /** Half the surface of the box that begins there in `nodes`. */
  def area(at: Int): Float =
    val x = nodes(at + 3) - nodes(at)
    val y = nodes(at + 4) - nodes(at + 1)
    val z = nodes(at + 5) - nodes(at + 2)
    x * y + y * z + z * x

  def rootArea: Float =
    def side(k: Int) =
      Math.max(nodes(root + 3 + k), nodes(root + 9 + k)) -
        Math.min(nodes(root + k), nodes(root + 6 + k))
    side(0) * side(1) + side(1) * side(2) + side(2) * side(0)

/** Builds hierarchies top-down by the surface area heuristic; [[Cut]] says how a range of
  * primitives is divided.
  *
  * The records of the primitives' boxes (see [[BoxRecord]]) are sorted in place on the way down, so
  * that each pass reads them one after the other. The upper part of the tree is built by all
  * threads together, a division at a time; below it each takes whole subtrees. The tree is the same
  * for any number of threads, bit for bit: what is left for later depends on the number of
  * primitives alone, and maxima and counts don't depend on who finds them first.
  */
private[accel] object BvhBuilder:
  inline val NodeFloats = 16

  /** Of a box pair, in units of a primitive test (measured: about one). */
  inline val TraversalCost = 1f

  /** From here on halves, which bounds the depth by this + log2(primitives). */
  inline val MaxSahDepth = 64

  /** Subtrees are built by one thread each if they have no more records than this, or than a part
    * of the whole tree: small enough that all threads end at about the same time.
    */
  private val LeastDeferred = 1 << 15
  private val DeferredParts = 64

  private def partSize(count: Int): Int = Math.max(LeastDeferred, count / DeferredParts)

  /** @param bounds six Floats a primitive */
  def apply(bounds: Array[Float], maxLeaf: Int, parallel: Parallel = Parallel.Alone): BvhBuilder =
    val records = new Array[Int](Math.multiplyExact(BoxRecord.Ints, bounds.length / 6))
    loop(bounds.length / 6): i =>
      val b = 6 * i
      BoxRecord.write(
        records,
        i * BoxRecord.Ints,
        i,
        bounds(b),
        bounds(b + 1),
        bounds(b + 2),
        bounds(b + 3),
        bounds(b + 4),
        bounds(b + 5)
      )
    ofRecords(records, LeafSize.single(maxLeaf), parallel)

  def of(primitives: Primitives, size: LeafSize, parallel: Parallel): BvhBuilder =
    ofRecords(primitives.records(parallel), size, parallel)

  /** Sorts the records on the way. */
  private def ofRecords(records: Array[Int], size: LeafSize, parallel: Parallel): BvhBuilder =
    val count = records.length / BoxRecord.Ints
    val levels = Levels()
    levels.open(0)
    union(records, parallel, levels.boxes)
    val bounds = boundsOf(levels.boxes)
    val binOf = Array.fill(3)(new Array[Byte](count))
    val together = SharedCut(records, size.shift, binOf, parallel)
    val deferred = partSize(count)
    val top = SubtreeBuilder(records, together, levels, size, deferred)
    val topRoot = top.build(0, count, 0)
    val topSize = top.leafSize
    val later = top.later.toArray
    val parts = new Array[Subtree](later.length)
    parallel.each(later.length): i =>
      val part = later(i)
      val builder =
        SubtreeBuilder(records, BinnedCut(records, size.shift, binOf), part.levels, size)
      val root = builder.build(part.first, part.end, part.depth)
      parts(i) = Subtree(root, builder.leafSize, builder.trimmedNodes)
    val order = new Array[Int](count)
    parallel.ranges(count): (from, until) =>
      var i = from
      while i < until do
        order(i) = records(i * BoxRecord.Ints + BoxRecord.Number)
        i += 1
    val whole = Subtree.join(Subtree(topRoot, topSize, top.trimmedNodes), parts, parallel)
    new BvhBuilder(order, whole.nodes, whole.root, whole.leafSize, bounds)

  private def union(records: Array[Int], parallel: Parallel, to: Array[Int]): Unit =
    BoxRecord.clear(to, 0)
    parallel.ranges(records.length / BoxRecord.Ints): (from, until) =>
      val box = new Array[Int](BoxRecord.Ints)
      BoxRecord.uniteInto(box, 0, records, from, until)
      to.synchronized(BoxRecord.grow(to, 0, box, 0))

  private def boundsOf(box: Array[Int]): Bounds3 =
    val b = new Array[Float](6)
    BoxRecord.read(box, 0, b, 0)
    if b(0) > b(3) then Bounds3.Empty else Bounds3(Vec3(b(0), b(1), b(2)), Vec3(b(3), b(4), b(5)))
