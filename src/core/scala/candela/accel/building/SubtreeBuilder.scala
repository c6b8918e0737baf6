package candela.accel.building

import candela.base.{FloatBuffer, loop}
import candela.concurrency.Parallel
import candela.accel.BinaryTree
import candela.geometry.Bounds3

/** Builds a subtree over a range of records, which it sorts in place. One per worker.
  *
  * @param records  see [[BoxRecord]]
  * @param cut      split strategy for large ranges
  * @param levels   hold the bounds of the range to build
  * @param size     leaf size
  * @param deferred ranges of at most this many records are deferred; 0 for none
  */
private[building] final class SubtreeBuilder(
    records: Array[Int],
    cut: => Cut,
    levels: Levels,
    size: LeafSize,
    deferred: Int = 0
):
  import BinaryTree.NodeFloats

  /** If a block holds as many triangles as [[FewCut]] splits, only ranges with other primitives get
    * there: their cost is per primitive.
    */
  private lazy val exactCut =
    FewCut(records, if size.block < FewCut.MaxRange then size.shift else 0)

  // Most trees of many need neither
  private lazy val largeCut = cut

  val nodes = FloatBuffer()
  private val row = new Array[Float](NodeFloats)

  /** Deferred ranges: a child that looks like a leaf of −k primitives is the kth of these. */
  val deferredRanges = scala.collection.mutable.ArrayBuffer.empty[DeferredRange]

  /** Number of primitives in the leaf that [[build]] last made; 0 if it made a node. */
  var leafSize = 0

  /** Builds the subtree over records[first, end), whose bounds and range are at `depth`; returns
    * its child code.
    */
  def build(first: Int, end: Int, depth: Int): Int =
    val n = end - first
    if n <= deferred then defer(first, end, depth)
    else if n <= 1 || size.isLeaf(records, first, end) then leaf(first, end)
    else
      val chosenCut = if n <= FewCut.MaxRange then exactCut else largeCut
      val isCut = depth < BvhBuilder.MaxSahDepth && chosenCut.findSplit(first, end, levels, depth)
      if !isCut then if n <= size.maxPrimitives then leaf(first, end) else halve(first, end, depth)
      else if n <= size.maxPrimitives && n <= costOf(chosenCut, depth) then leaf(first, end)
      else
        val node = nodes.length
        val middle = first + chosenCut.leftCount
        chosenCut.divide(first, end)
        chosenCut.descend(levels, depth)
        val offset = depth * BoxRecord.Ints
        BoxRecord.read(levels.boxes, offset + BoxRecord.Ints, row, 0)
        BoxRecord.read(levels.boxes, offset, row, 6)
        nodes ++= row
        setChild(node, 0, build(first, middle, depth + 1))
        levels.descend(depth)
        setChild(node, 1, build(middle, end, depth + 1))
        leafSize = 0
        node

  private def costOf(chosenCut: Cut, depth: Int): Float =
    val area = BoxRecord.halfArea(levels.boxes, depth * BoxRecord.Ints)
    BvhBuilder.TraversalCost + chosenCut.cost / Math.max(area, Float.MinPositiveValue)

  private def leaf(first: Int, end: Int): Int =
    leafSize = end - first
    ~first

  private def defer(first: Int, end: Int, depth: Int): Int =
    deferredRanges += DeferredRange(first, end, depth, levels.copy(depth))
    leafSize = -deferredRanges.length
    ~first

  /** Median split by position in the array, ignoring the geometry. */
  private def halve(first: Int, end: Int, depth: Int): Int =
    val node = nodes.length
    nodes ++= row
    val middle = (first + end) >>> 1
    buildHalf(node, 0, first, middle, depth)
    buildHalf(node, 1, middle, end, depth)
    leafSize = 0
    node

  private def buildHalf(node: Int, side: Int, first: Int, end: Int, depth: Int): Unit =
    levels.descend(depth)
    val offset = (depth + 1) * BoxRecord.Ints
    BoxRecord.uniteInto(levels.boxes, offset, records, first, end)
    BoxRecord.read(levels.boxes, offset, row, 0)
    loop(6)(k => nodes(node + 6 * side + k) = row(k))
    setChild(node, side, build(first, end, depth + 1))

  private def setChild(node: Int, side: Int, code: Int): Unit =
    nodes(node + 12 + side) = java.lang.Float.intBitsToFloat(code)
    nodes(node + 14 + side) = java.lang.Float.intBitsToFloat(leafSize)

/** A range of records whose subtree is still to be built.
  *
  * @param levels hold its bounds and range at `depth`
  */
private[building] final class DeferredRange(
    val start: Int,
    val end: Int,
    val depth: Int,
    val levels: Levels
)

/** A part of a tree in the layout of [[BinaryTree]]; node indices are relative to its own first
  * Float.
  *
  * @param leafSize size of the root, if it is a leaf; −k if it is the kth deferred part
  */
private[building] final class Subtree(val root: Int, val leafSize: Int, val nodes: FloatBuffer)

private[building] object Subtree:
  import BinaryTree.NodeFloats

  /** Joins the upper part `top` and its deferred parts into one tree. */
  def join(
      top: Subtree,
      parts: Array[Subtree],
      order: Array[Int],
      bounds: Bounds3,
      parallel: Parallel
  ): BinaryTree =
    val starts = parts.scanLeft(top.nodes.length.toLong)(_ + _.nodes.length)
    if starts.last > Int.MaxValue - 8 then
      val count = starts.last / NodeFloats
      throw IllegalStateException(s"a BVH of $count nodes exceeds the maximum array length")
    val joinedNodes = new Array[Float](starts.last.toInt)
    top.nodes.copyTo(joinedNodes, 0)
    parallel.forEach(parts.length): i =>
      val start = starts(i).toInt
      parts(i).nodes.copyTo(joinedNodes, start)
      children(joinedNodes, start, starts(i + 1).toInt): (at, code, _) =>
        setBits(joinedNodes, at, moved(code, start))
    def rootOf(k: Int) = moved(parts(k).root, starts(k).toInt)
    children(joinedNodes, 0, top.nodes.length): (at, _, size) =>
      if size < 0 then
        setBits(joinedNodes, at, rootOf(-size - 1))
        setBits(joinedNodes, at + 2, parts(-size - 1).leafSize)
    val size = top.leafSize
    val (root, rootSize) =
      if size < 0 then (rootOf(-size - 1), parts(-size - 1).leafSize) else (top.root, size)
    BinaryTree(order, joinedNodes, root, rootSize, bounds)

  private def moved(code: Int, start: Int): Int = if code < 0 then code else code + start

  /** Visits every child: the offset of its code, the code, and its size. */
  private inline def children(nodes: Array[Float], from: Int, until: Int)(
      inline use: (Int, Int, Int) => Unit
  ): Unit =
    var node = from
    while node < until do
      loop(2): side =>
        val offset = node + 12 + side
        use(offset, bits(nodes, offset), bits(nodes, offset + 2))
      node += NodeFloats

  private def bits(nodes: Array[Float], at: Int): Int =
    java.lang.Float.floatToRawIntBits(nodes(at))

  private def setBits(nodes: Array[Float], at: Int, value: Int): Unit =
    nodes(at) = java.lang.Float.intBitsToFloat(value)

/** Leaf size of the binary BVH.
  *
  * The triangles of a block are tested at the cost of one, so a range that fits into a block is not
  * split, and splits are priced by their number of blocks, as in Wald, Woop, Benthin, Johnson,
  * Ernst, "Embree: A Kernel Framework for Efficient CPU Ray Tracing", TOG 33(4), 2014.
  *
  * @param maxPrimitives maximum number of primitives of any kind, if a leaf is cheaper than a split
  * @param block   triangles per block, a power of two; 1 without blocks
  * @param isPlain whether a primitive may be in a block
  * @param unsplit other primitives of which a range is not split, even if rays were faster then
  */
private[accel] final class LeafSize(
    val maxPrimitives: Int,
    val block: Int,
    isPlain: Int => Boolean,
    unsplit: Int = 1
):
  /** log2 of `block`, the granularity of the SAH cost in [[Sweep]]. */
  val shift: Int = Integer.numberOfTrailingZeros(block)

  /** Whether these records are a leaf in any case. */
  def isLeaf(records: Array[Int], first: Int, end: Int): Boolean =
    val n = end - first
    n <= Math.max(block, unsplit) && {
      val areBlock = isPlainAt(records, first)
      var i = first + 1
      if n <= (if areBlock then block else unsplit) then
        while i < end && isPlainAt(records, i) == areBlock do i += 1
      i == end
    }

  private def isPlainAt(records: Array[Int], i: Int): Boolean =
    isPlain(records(i * BoxRecord.Ints + BoxRecord.Number))

private[accel] object LeafSize:
  /** No blocks: primitives are tested one by one. */
  def single(maxPrimitives: Int): LeafSize = LeafSize(maxPrimitives, 1, _ => true)
