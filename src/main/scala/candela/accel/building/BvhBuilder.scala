package candela.accel.building

import candela.accel.{BinaryTree, Primitives}
import candela.base.Parallel
import candela.geometry.Bounds3
import candela.math.Vec3

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
  /** Of a box pair, in units of a primitive test (measured: about one). */
  inline val TraversalCost = 1f

  /** From here on halves, which bounds the depth by this + log2(primitives). */
  inline val MaxSahDepth = 64

  /** Subtrees are built by one thread each if they have no more records than this, or than a part
    * of the whole tree: small enough that all threads end at about the same time.
    */
  private val LeastDeferred = 1 << 15
  private val DeferredParts = 64

  def partSize(count: Int): Int = Math.max(LeastDeferred, count / DeferredParts)

  def of(primitives: Primitives, size: LeafSize, parallel: Parallel): BinaryTree =
    ofRecords(BoxRecord.all(primitives, parallel), size, parallel)

  /** Sorts the records on the way. */
  private[building] def ofRecords(
      records: Array[Int],
      size: LeafSize,
      parallel: Parallel
  ): BinaryTree =
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
    BinaryTree(order, whole.nodes, whole.root, whole.leafSize, bounds)

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
