package candela.accel

import candela.base.{loop, Parallel}

/** Makes nodes and leaves of a [[WideTree]] from the binary tree that [[BvhBuilder]] leaves, as a
  * [[CollapsePlan]] finds best.
  *
  * One thread writes the upper part; below it each writes whole subtrees, which are put behind it
  * in their order. How many there are depends on the number of primitives alone, so all is the
  * same, bit for bit, for any number of threads.
  */
private[accel] final class WideBuilder(
    width: Int,
    lanes: Int,
    tree: BvhBuilder,
    isTriangle: Int => Boolean,
    parallel: Parallel
):
  private val plan = CollapsePlan(width, lanes, tree, isTriangle, parallel)
  private val top = WideWriter(width, lanes, tree, plan, tree.partSize, tree.partSize)
  private val topCode =
    if tree.order.length == 0 then WideTree.Nothing else top.write(tree.root, tree.rootCount, 0)

  private val later = top.later.toVector
  private val writers = new Array[WideWriter](1 + later.length)
  private val codes = new Array[Int](1 + later.length)
  writers(0) = top
  codes(0) = topCode
  parallel.each(later.length): i =>
    val node = later(i).node
    val part = WideWriter(width, lanes, tree, plan, partSize = 0, expected = tree.count(node))
    codes(i + 1) = part.write(node, 0, later(i).waiting)
    writers(i + 1) = part

  /** The most entries that a walk's stack can have. */
  val stackNeed: Int = writers.map(_.stackNeed).max

  private val nodeStarts = starts(_.nodes.length)
  private val ownerStarts = starts(_.owners.length)
  private val otherStarts = starts(_.others.length)

  /** Rows as a [[WideTree]] has them. */
  val nodes: Array[Float] = new Array[Float](nodeStarts.last)

  /** Which primitives are in the lanes of the blocks; −1: none. */
  val owners: Array[Int] = new Array[Int](ownerStarts.last)

  /** Which primitives are in the leaves that are no blocks. */
  val others: Array[Int] = new Array[Int](otherStarts.last)

  parallel.each(writers.length): i =>
    val part = writers(i)
    part.owners.copyTo(owners, ownerStarts(i))
    part.others.copyTo(others, otherStarts(i))
    part.nodes.copyTo(nodes, nodeStarts(i))
    if i > 0 then
      var node = nodeStarts(i)
      while node < nodeStarts(i + 1) do
        loop(width): k =>
          val at = node + 6 * width + k
          val code = java.lang.Float.floatToRawIntBits(nodes(at))
          nodes(at) = java.lang.Float.intBitsToFloat(moved(code, i))
        node += WideTree.floats(width)
  for i <- later.indices do
    nodes(later(i).codeAt) = java.lang.Float.intBitsToFloat(moved(codes(i + 1), i + 1))

  /** A child's code as in a [[WideTree]]. */
  def rootCode: Int = topCode

  private def starts(length: WideWriter => Int): Array[Int] =
    val all = writers.scanLeft(0L)(_ + length(_))
    if all.last > Int.MaxValue - 8 then
      throw IllegalStateException("a hierarchy has no place in an array")
    all.map(_.toInt)

  /** What a code of part `i` is in the whole. */
  private def moved(code: Int, i: Int): Int =
    if code == WideTree.Nothing then code
    else if code >= 0 then code + nodeStarts(i)
    else
      val isBlock = WideTree.isBlock(code)
      val start = if isBlock then ownerStarts(i) / lanes else otherStarts(i)
      WideTree.leaf(isBlock, WideTree.first(code) + start, WideTree.size(code))
