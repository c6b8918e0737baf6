package candela.accel.building

import candela.concurrency.Parallel
import candela.accel.{BinaryTree, Primitives}
import candela.geometry.Bounds3
import candela.math.Vec3

/** Top-down binary BVH builder using the surface area heuristic (SAH); [[Cut]] splits a range of
  * primitives.
  *
  * Sorts the primitives' records (see [[BoxRecord]]) in place, so that each pass reads them
  * sequentially. All threads together build the upper part of the tree, one split at a time; below
  * it, each builds whole subtrees. The tree is bit-identical for any number of threads: the
  * subtrees depend on the number of primitives only, and maxima and counts do not depend on their
  * order.
  */
private[accel] object BvhBuilder:
  /** Cost of testing a pair of boxes, in units of a primitive test (measured: about one). */
  inline val TraversalCost = 1f

  /** Depth from which median splits replace SAH splits, which bounds the depth by this +
    * log2(primitives).
    */
  inline val MaxSahDepth = 64

  /** Of any tree. */
  inline val MaxDepth = MaxSahDepth + 32

  /** Largest subtree built by a single thread, in records, and as a fraction of the whole tree:
    * small enough that all threads finish at about the same time.
    */
  private val MinDeferred = 1 << 15
  private val DeferredParts = 64

  def partSize(count: Int): Int = Math.max(MinDeferred, count / DeferredParts)

  def of(primitives: Primitives, size: LeafSize, parallel: Parallel): BinaryTree =
    ofRecords(BoxRecord.ofAll(primitives, parallel), size, parallel)

  /** Builds the tree of records, which are garbage before its parts are joined. */
  private[building] def ofRecords(
      records: => Array[Int],
      size: LeafSize,
      parallel: Parallel
  ): BinaryTree =
    val pieces = split(records, size, parallel)
    Subtree.join(pieces.top, pieces.subtrees, pieces.order, pieces.bounds, parallel)

  /** The parts of a tree. */
  private final class Pieces(
      val order: Array[Int],
      val top: Subtree,
      val subtrees: Array[Subtree],
      val bounds: Bounds3
  )

  /** Builds the parts and sorts `records`. */
  private def split(records: Array[Int], size: LeafSize, parallel: Parallel): Pieces =
    val count = records.length / BoxRecord.Ints
    val levels = Levels()
    levels.resetRange(0)
    union(records, parallel, levels.boxes)
    val bounds = boundsOf(levels.boxes)
    val binOf = Array.fill(3)(new Array[Byte](count))
    val deferred = partSize(count)
    def together = SharedCut(records, size.shift, binOf, parallel)
    val top = SubtreeBuilder(records, together, levels, size, deferred)
    val topRoot = top.build(0, count, 0)
    val topSize = top.leafSize
    val deferredRanges = top.deferredRanges.toArray
    val subtrees = new Array[Subtree](deferredRanges.length)
    parallel.forEach(deferredRanges.length): i =>
      val range = deferredRanges(i)
      val builder =
        SubtreeBuilder(records, BinnedCut(records, size.shift, binOf), range.levels, size)
      val root = builder.build(range.start, range.end, range.depth)
      subtrees(i) = Subtree(root, builder.leafSize, builder.nodes)
    val order = new Array[Int](count)
    parallel.ranges(count): (from, until) =>
      var i = from
      while i < until do
        order(i) = records(i * BoxRecord.Ints + BoxRecord.Number)
        i += 1
    Pieces(order, Subtree(topRoot, topSize, top.nodes), subtrees, bounds)

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
