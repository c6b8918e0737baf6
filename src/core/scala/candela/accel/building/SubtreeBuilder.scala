package candela.accel.building

import candela.accel.BinaryTree
import candela.base.{loop, Parallel}

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
    cut: Cut,
    levels: Levels,
    size: LeafSize,
    deferred: Int = 0
):
  import BinaryTree.NodeFloats

  /** If a block holds as many triangles as [[FewCut]] splits, only ranges with other primitives get
    * there: their cost is per primitive.
    */
  private val few = FewCut(records, if size.block < FewCut.MaxRange then size.shift else 0)

  private var nodes = new Array[Float](NodeFloats * 64)
  private var length = 0

  /** Deferred ranges: a child that looks like a leaf of −k primitives is the kth of these. */
  val later = scala.collection.mutable.ArrayBuffer.empty[Later]

  def trimmedNodes: Array[Float] = java.util.Arrays.copyOf(nodes, length)

  /** Number of primitives in the leaf that [[build]] last made; 0 if it made a node. */
  var leafSize = 0

  /** Builds the subtree over records[first, end), whose bounds and range are at `depth`; returns
    * its child code.
    */
  def build(first: Int, end: Int, depth: Int): Int =
    val n = end - first
    if n <= deferred then leave(first, end, depth)
    else if n <= 1 || size.isLeaf(records, first, end) then leaf(first, end)
    else
      val how = if n <= FewCut.MaxRange then few else cut
      val isCut = depth < BvhBuilder.MaxSahDepth && how.find(first, end, levels, depth)
      if !isCut then if n <= size.most then leaf(first, end) else halve(first, end, depth)
      else if n <= size.most && n <= costOf(how, depth) then leaf(first, end)
      else
        val node = newNode()
        val middle = first + how.left
        how.divide(first, end)
        how.descend(levels, depth)
        val here = depth * BoxRecord.Ints
        BoxRecord.read(levels.boxes, here + BoxRecord.Ints, nodes, node)
        BoxRecord.read(levels.boxes, here, nodes, node + 6)
        setChild(node, 0, build(first, middle, depth + 1))
        levels.descend(depth)
        setChild(node, 1, build(middle, end, depth + 1))
        leafSize = 0
        node

  private def costOf(how: Cut, depth: Int): Float =
    val area = BoxRecord.halfArea(levels.boxes, depth * BoxRecord.Ints)
    BvhBuilder.TraversalCost + how.cost / Math.max(area, Float.MinPositiveValue)

  private def leaf(first: Int, end: Int): Int =
    leafSize = end - first
    ~first

  private def leave(first: Int, end: Int, depth: Int): Int =
    later += Later(first, end, depth, levels.copy(depth))
    leafSize = -later.length
    ~first

  /** Median split by position in the array, ignoring the geometry. */
  private def halve(first: Int, end: Int, depth: Int): Int =
    val node = newNode()
    val middle = (first + end) >>> 1
    half(node, 0, first, middle, depth)
    half(node, 1, middle, end, depth)
    leafSize = 0
    node

  private def half(node: Int, side: Int, first: Int, end: Int, depth: Int): Unit =
    levels.descend(depth)
    val at = (depth + 1) * BoxRecord.Ints
    BoxRecord.uniteInto(levels.boxes, at, records, first, end)
    BoxRecord.read(levels.boxes, at, nodes, node + 6 * side)
    setChild(node, side, build(first, end, depth + 1))

  private def setChild(node: Int, side: Int, code: Int): Unit =
    nodes(node + 12 + side) = java.lang.Float.intBitsToFloat(code)
    nodes(node + 14 + side) = java.lang.Float.intBitsToFloat(leafSize)

  private def newNode(): Int =
    val at = length
    length += NodeFloats
    if length > nodes.length then
      nodes = java.util.Arrays.copyOf(nodes, SubtreeBuilder.more(nodes.length))
    at

private[building] object SubtreeBuilder:

  /** Doubles a capacity, up to the maximum. */
  private def more(length: Int): Int =
    val most = Int.MaxValue / BinaryTree.NodeFloats * BinaryTree.NodeFloats
    if length == most then throw IllegalStateException("the BVH exceeds the maximum array length")
    Math.min(2L * length, most.toLong).toInt

/** A range of records whose subtree is still to be built.
  *
  * @param levels hold its bounds and range at `depth`
  */
private[building] final class Later(
    val first: Int,
    val end: Int,
    val depth: Int,
    val levels: Levels
)

/** A part of a tree in the layout of [[BinaryTree]]; node indices are relative to its own first
  * Float.
  *
  * @param leafSize size of the root, if it is a leaf; −k if it is the kth deferred part
  */
private[building] final class Subtree(val root: Int, val leafSize: Int, val nodes: Array[Float])

private[building] object Subtree:
  import BinaryTree.NodeFloats

  /** Joins the upper part `top` and its deferred parts into one tree. */
  def join(top: Subtree, parts: Array[Subtree], parallel: Parallel): Subtree =
    val starts = parts.scanLeft(top.nodes.length.toLong)(_ + _.nodes.length)
    if starts.last > Int.MaxValue - 8 then
      val count = starts.last / NodeFloats
      throw IllegalStateException(s"a BVH of $count nodes exceeds the maximum array length")
    val all = java.util.Arrays.copyOf(top.nodes, starts.last.toInt)
    parallel.each(parts.length): i =>
      val start = starts(i).toInt
      System.arraycopy(parts(i).nodes, 0, all, start, parts(i).nodes.length)
      children(all, start, starts(i + 1).toInt): (at, code, _) =>
        setBits(all, at, moved(code, start))
    def rootOf(k: Int) = moved(parts(k).root, starts(k).toInt)
    children(all, 0, top.nodes.length): (at, _, size) =>
      if size < 0 then
        setBits(all, at, rootOf(-size - 1))
        setBits(all, at + 2, parts(-size - 1).leafSize)
    val size = top.leafSize
    if size < 0 then Subtree(rootOf(-size - 1), parts(-size - 1).leafSize, all)
    else Subtree(top.root, size, all)

  private def moved(code: Int, start: Int): Int = if code < 0 then code else code + start

  /** Visits every child: the offset of its code, the code, and its size. */
  private inline def children(nodes: Array[Float], from: Int, until: Int)(
      inline use: (Int, Int, Int) => Unit
  ): Unit =
    var node = from
    while node < until do
      loop(2): side =>
        val at = node + 12 + side
        use(at, bits(nodes, at), bits(nodes, at + 2))
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
  * @param most    maximum number of primitives of any kind, if a leaf is cheaper than a split
  * @param block   triangles per block, a power of two; 1 without blocks
  * @param isPlain whether a primitive may be in a block
  * @param unsplit other primitives of which a range is not split, even if rays were faster then
  */
private[accel] final class LeafSize(
    val most: Int,
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
  def single(most: Int): LeafSize = LeafSize(most, 1, _ => true)
