package candela.accel.building

import candela.base.{FloatBuffer, IntBuffer, loop}
import candela.concurrency.Parallel
import candela.accel.{BinaryTree, Primitives, Relocation, WideLayout, WideTree}
import candela.geometry.Bounds3
import candela.shapes.TriangleSoup

/** Collapses the binary BVH of [[BvhBuilder]] into the nodes and leaves of a [[WideTree]],
  * following a [[CollapsePlan]].
  *
  * One thread writes the upper part; below it, each thread writes whole subtrees, which are
  * appended in order. Their number depends on the number of primitives only: the result is
  * bit-identical for any number of threads.
  */
private final class WideBuilder(
    width: Int,
    lanes: Int,
    tree: BinaryTree,
    isTriangle: Int => Boolean,
    parallel: Parallel
):
  private val partSize = BvhBuilder.partSize(tree.order.length)
  private val plan = CollapsePlan(width, lanes, tree, isTriangle, parallel)
  private val top = WideWriter(width, lanes, tree, plan, partSize)
  private val topCode =
    if tree.order.length == 0 then WideTree.NoChild else top.write(tree.root, tree.rootCount)

  private val deferredSubtrees = top.deferred.toVector
  private val writers = new Array[WideWriter](1 + deferredSubtrees.length)
  private val codes = new Array[Int](1 + deferredSubtrees.length)
  writers(0) = top
  codes(0) = topCode
  parallel.forEach(deferredSubtrees.length): i =>
    val node = deferredSubtrees(i).node
    val writer = WideWriter(width, lanes, tree, plan, partSize = 0)
    codes(i + 1) = writer.write(node, 0)
    writers(i + 1) = writer

  private val nodeStarts = starts(_.nodes.length)
  private val ownerStarts = starts(_.owners.length)
  private val unblockedStarts = starts(_.unblocked.length)

  /** Rows in the layout of [[WideTree]]. */
  val nodes: Array[Float] = new Array[Float](nodeStarts.last)

  /** Primitives in the lanes of the blocks; −1 if empty. */
  val owners: Array[Int] = new Array[Int](ownerStarts.last)

  /** Primitives in the leaves other than blocks. */
  val unblocked: Array[Int] = new Array[Int](unblockedStarts.last)

  parallel.forEach(writers.length): i =>
    val writer = writers(i)
    writer.owners.copyTo(owners, ownerStarts(i))
    writer.unblocked.copyTo(unblocked, unblockedStarts(i))
    writer.nodes.copyTo(nodes, nodeStarts(i))
    if i > 0 then relocation(i).relocate(nodes, nodeStarts(i), nodeStarts(i + 1), width)
  for i <- deferredSubtrees.indices do
    val code = relocation(i + 1).moved(codes(i + 1))
    nodes(deferredSubtrees(i).codeAt) = java.lang.Float.intBitsToFloat(code)

  /** Child code in the encoding of [[WideTree]]. */
  def rootCode: Int = topCode

  private def starts(length: WideWriter => Int): Array[Int] =
    val offsets = writers.scanLeft(0L)(_ + length(_))
    if offsets.last > Int.MaxValue - 8 then
      throw IllegalStateException("the BVH exceeds the maximum array length")
    offsets.map(_.toInt)

  /** Of part `i` in the whole tree. */
  private def relocation(i: Int): Relocation =
    Relocation(nodeStarts(i), ownerStarts(i) / lanes, unblockedStarts(i))

private[accel] object WideBuilder:

  /** @param maxLeaf maximum leaf size of the binary BVH, except for triangles
    * @param unsplit see [[LeafSize]]
    */
  def of(
      primitives: Primitives,
      width: Int,
      lanes: Int,
      maxLeaf: Int,
      parallel: Parallel,
      unsplit: Int = 1
  ): WideTree =
    def records = BoxRecord.ofAll(primitives, parallel)
    layout(
      primitives, records, width, lanes, maxLeaf, parallel, unsplit
    ).withPrimitives(primitives, parallel)

  /** The layout of some of the primitives.
    *
    * @param records of these, which are made when they are needed, and sorted
    */
  def layout(
      primitives: Primitives,
      records: => Array[Int],
      width: Int,
      lanes: Int,
      maxLeaf: Int,
      parallel: Parallel,
      unsplit: Int = 1
  ): WideLayout =
    val hierarchy = collapsed(primitives, records, width, lanes, maxLeaf, parallel, unsplit)
    WideLayout(
      width,
      lanes,
      hierarchy.count,
      hierarchy.bounds,
      hierarchy.nodes,
      hierarchy.rootCode,
      blocks(primitives.soup, hierarchy.owners, lanes, parallel),
      hierarchy.unblocked
    )

  /** What is left of a binary tree and its [[WideBuilder]]: the rest, twice as much, is garbage
    * before blocks are made.
    */
  private final class Collapsed(
      val count: Int,
      val bounds: Bounds3,
      val nodes: Array[Float],
      val rootCode: Int,
      val owners: Array[Int],
      val unblocked: Array[Int]
  )

  private def collapsed(
      primitives: Primitives,
      records: => Array[Int],
      width: Int,
      lanes: Int,
      maxLeaf: Int,
      parallel: Parallel,
      unsplit: Int
  ): Collapsed =
    val size = LeafSize(maxLeaf, lanes, primitives.isTriangle, unsplit)
    val built = BvhBuilder.ofRecords(records, size, parallel)
    val wide = WideBuilder(width, lanes, built, primitives.isTriangle, parallel)
    Collapsed(
      built.order.length,
      built.bounds,
      wide.nodes,
      wide.rootCode,
      wide.owners,
      wide.unblocked
    )

  private def blocks(
      soup: TriangleSoup,
      owners: Array[Int],
      lanes: Int,
      parallel: Parallel
  ): Array[Float] =
    val blockData = new Array[Float](Math.multiplyExact(10, owners.length))
    parallel.ranges(owners.length): (from, until) =>
      var i = from
      while i < until do
        val triangle = owners(i)
        val offset = i / lanes * WideTree.blockFloats(lanes) + i % lanes
        blockData(offset + 9 * lanes) = java.lang.Float.intBitsToFloat(triangle)
        if triangle >= 0 then
          var c = 0
          while c < 9 do
            blockData(offset + c * lanes) =
              soup.positions(3 * soup.indices(3 * triangle + c / 3) + c % 3)
            c += 1
        i += 1
    blockData

/** Writes the nodes and leaves of a [[WideTree]] or a part of one, following a [[CollapsePlan]].
  * One per thread. Indices in its codes are relative to its own first node, block or slot.
  *
  * @param partSize subtrees of at most this many primitives are deferred; 0 for none
  */
private[building] final class WideWriter(
    width: Int,
    lanes: Int,
    tree: BinaryTree,
    plan: CollapsePlan,
    partSize: Int
):
  val nodes = FloatBuffer()

  /** Primitives in the lanes of the blocks; −1 if empty. */
  val owners = IntBuffer()

  /** Primitives in the leaves other than blocks. */
  val unblocked = IntBuffer()

  private val padded = new Array[Float](6)
  private val nodeFloats = new Array[Float](WideTree.floats(width))

  /** Deferred subtrees, with the offsets of their codes. */
  val deferred = scala.collection.mutable.ArrayBuffer.empty[WideWriter.Deferred]

  /** Writes the collapsed form of a binary node or, below 0, of a leaf with `size` primitives;
    * returns its code.
    */
  def write(code: Int, size: Int): Int =
    if code < 0 then leaf(~code, ~code + size)
    else if plan.choice(code, 1) == 0 then leaf(tree.firstSlot(code), tree.endSlot(code))
    else node(code)

  private def leaf(first: Int, end: Int): Int =
    if plan.isBlock(first, end) then
      val block = owners.length / lanes
      var i = 0
      while i < lanes do
        owners += (if first + i < end then tree.order(first + i) else -1)
        i += 1
      WideTree.leaf(isBlock = true, block, end - first)
    else
      val start = unblocked.length
      var i = first
      while i < end do
        unblocked += tree.order(i)
        i += 1
      WideTree.leaf(isBlock = false, start, end - first)

  /** Writes the wide node that replaces this binary node, and all below it. */
  private def node(binary: Int): Int =
    val nodeStart = nodes.length
    val boxes = new Array[Int](width) // offsets of the children's boxes in the binary tree
    val count = gather(binary, plan.choice(binary, 1), width, boxes, 0)
    loop(width): k =>
      if k < count then
        System.arraycopy(tree.nodes, boxes(k), padded, 0, 6)
        WideTree.pad(padded, 0)
        WideTree.writeBox(nodeFloats.update)(0, k, width, padded)
      else WideTree.writeEmpty(nodeFloats.update)(0, k, width)
    nodes ++= nodeFloats
    loop(count): k =>
      val parent = boxes(k) & -BinaryTree.NodeFloats
      val side = if boxes(k) == parent then 0 else 1
      val child = tree.child(parent, side)
      val codeAt = nodeStart + 6 * width + k
      if child >= 0 && partSize > 0 && tree.count(child) <= partSize then
        deferred += WideWriter.Deferred(child, codeAt)
      else
        val code = write(child, tree.leafSize(parent, side))
        nodes(codeAt) = java.lang.Float.intBitsToFloat(code)
    nodeStart

  /** Appends the children of `binary`, with `left` of `k` in its left subtree. */
  private def gather(binary: Int, left: Int, k: Int, boxes: Array[Int], count: Int): Int =
    val attached = collapseChild(binary, 0, left, boxes, count)
    collapseChild(binary, 1, k - left, boxes, attached)

  private def collapseChild(
      parent: Int,
      side: Int,
      maxChildren: Int,
      boxes: Array[Int],
      count: Int
  ): Int =
    val child = tree.child(parent, side)
    var k = maxChildren
    if child >= 0 then while k > 1 && plan.choice(child, k) == 0 do k -= 1
    if child < 0 || k == 1 then
      boxes(count) = parent + 6 * side
      count + 1
    else gather(child, plan.choice(child, k), k, boxes, count)

private[building] object WideWriter:

  /** A binary node whose subtree is still to be written.
    *
    * @param codeAt offset at which to store its code
    */
  final class Deferred(val node: Int, val codeAt: Int)
