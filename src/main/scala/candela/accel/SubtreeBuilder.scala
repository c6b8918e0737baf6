package candela.accel

/** Builds a subtree over a range of records, which it sorts in place. Belongs to one worker.
  *
  * @param records  see [[BoxRecord]]
  * @param cut      for more than a few records
  * @param levels   know the box of the range that is built
  * @param size     of leaves
  * @param deferred ranges of at most so many records are left for later; 0: none
  */
private[accel] final class SubtreeBuilder(
    records: Array[Int],
    cut: Cut,
    levels: Levels,
    size: LeafSize,
    deferred: Int = 0
):
  import BvhBuilder.NodeFloats

  /** No more of what is in blocks than one of them is ever cut: it is other things. */
  private val few = FewCut(records, if size.block < FewCut.Most then size.shift else 0)

  private var nodes = new Array[Float](NodeFloats * 64)
  private var length = 0

  /** What was left for later: a child that seems a leaf of −k primitives is the kth of these. */
  val later = scala.collection.mutable.ArrayBuffer.empty[Later]

  def trimmedNodes: Array[Float] = java.util.Arrays.copyOf(nodes, length)

  /** How many are in the leaf that [[build]] made last; 0: it made a node. */
  var leafSize = 0

  /** Makes the subtree over records[first, end), whose box and range are at `depth`; answers its
    * code as a child.
    */
  def build(first: Int, end: Int, depth: Int): Int =
    val n = end - first
    if n <= deferred then leave(first, end, depth)
    else if n <= 1 || size.isBlock(records, first, end) then leaf(first, end)
    else
      val how = if n <= FewCut.Most then few else cut
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

  /** Two parts of as many records, wherever they are. */
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

private[accel] object SubtreeBuilder:

  /** Twice as much room, as long as there can be. */
  private def more(length: Int): Int =
    val most = Int.MaxValue / BvhBuilder.NodeFloats * BvhBuilder.NodeFloats
    if length == most then throw IllegalStateException("a hierarchy has no place in an array")
    Math.min(2L * length, most.toLong).toInt

/** A range of records whose subtree is still to be built.
  *
  * @param levels know it at `depth`
  */
private[accel] final class Later(val first: Int, val end: Int, val depth: Int, val levels: Levels)
