package candela.accel.building

import candela.accel.{BinaryTree, Primitives, Relocation, WideLayout, WideTree}
import candela.base.{loop, FloatBuffer, IntBuffer, Parallel}
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

  private val later = top.later.toVector
  private val writers = new Array[WideWriter](1 + later.length)
  private val codes = new Array[Int](1 + later.length)
  writers(0) = top
  codes(0) = topCode
  parallel.each(later.length): i =>
    val node = later(i).node
    val part = WideWriter(width, lanes, tree, plan, partSize = 0)
    codes(i + 1) = part.write(node, 0)
    writers(i + 1) = part

  private val nodeStarts = starts(_.nodes.length)
  private val ownerStarts = starts(_.owners.length)
  private val otherStarts = starts(_.others.length)

  /** Rows in the layout of [[WideTree]]. */
  val nodes: Array[Float] = new Array[Float](nodeStarts.last)

  /** Primitives in the lanes of the blocks; −1 if empty. */
  val owners: Array[Int] = new Array[Int](ownerStarts.last)

  /** Primitives in the leaves other than blocks. */
  val others: Array[Int] = new Array[Int](otherStarts.last)

  parallel.each(writers.length): i =>
    val part = writers(i)
    part.owners.copyTo(owners, ownerStarts(i))
    part.others.copyTo(others, otherStarts(i))
    part.nodes.copyTo(nodes, nodeStarts(i))
    if i > 0 then relocation(i).relocate(nodes, nodeStarts(i), nodeStarts(i + 1), width)
  for i <- later.indices do
    val code = relocation(i + 1).moved(codes(i + 1))
    nodes(later(i).codeAt) = java.lang.Float.intBitsToFloat(code)

  /** Child code in the encoding of [[WideTree]]. */
  def rootCode: Int = topCode

  private def starts(length: WideWriter => Int): Array[Int] =
    val all = writers.scanLeft(0L)(_ + length(_))
    if all.last > Int.MaxValue - 8 then
      throw IllegalStateException("the BVH exceeds the maximum array length")
    all.map(_.toInt)

  /** Of part `i` in the whole tree. */
  private def relocation(i: Int): Relocation =
    Relocation(nodeStarts(i), ownerStarts(i) / lanes, otherStarts(i))

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
    def records = BoxRecord.all(primitives, parallel)
    layout(primitives, records, width, lanes, maxLeaf, parallel, unsplit).of(primitives, parallel)

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
    val found = collapsed(primitives, records, width, lanes, maxLeaf, parallel, unsplit)
    WideLayout(
      width,
      lanes,
      found.count,
      found.bounds,
      found.nodes,
      found.rootCode,
      blocks(primitives.soup, found.owners, lanes, parallel),
      found.others
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
      val others: Array[Int]
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
    val size = LeafSize(maxLeaf, lanes, primitives.isSolidTriangle, unsplit)
    val built = BvhBuilder.ofRecords(records, size, parallel)
    val wide = WideBuilder(width, lanes, built, primitives.isSolidTriangle, parallel)
    Collapsed(
      built.order.length,
      built.bounds,
      wide.nodes,
      wide.rootCode,
      wide.owners,
      wide.others
    )

  private def blocks(
      soup: TriangleSoup,
      owners: Array[Int],
      lanes: Int,
      parallel: Parallel
  ): Array[Float] =
    val all = new Array[Float](Math.multiplyExact(10, owners.length))
    parallel.ranges(owners.length): (from, until) =>
      var i = from
      while i < until do
        val triangle = owners(i)
        val at = i / lanes * WideTree.blockFloats(lanes) + i % lanes
        all(at + 9 * lanes) = java.lang.Float.intBitsToFloat(triangle)
        if triangle >= 0 then
          var c = 0
          while c < 9 do
            all(at + c * lanes) = soup.positions(3 * soup.indices(3 * triangle + c / 3) + c % 3)
            c += 1
        i += 1
    all

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
  val others = IntBuffer()

  private val padded = new Array[Float](6)
  private val whole = new Array[Float](WideTree.floats(width))

  /** Deferred subtrees, with the offsets of their codes. */
  val later = scala.collection.mutable.ArrayBuffer.empty[WideWriter.Later]

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
      val at = others.length
      var i = first
      while i < end do
        others += tree.order(i)
        i += 1
      WideTree.leaf(isBlock = false, at, end - first)

  /** Writes the wide node that replaces this binary node, and all below it. */
  private def node(binary: Int): Int =
    val at = nodes.length
    val boxes = new Array[Int](width) // offsets of the children's boxes in the binary tree
    val count = gather(binary, plan.choice(binary, 1), width, boxes, 0)
    loop(width): k =>
      if k < count then
        System.arraycopy(tree.nodes, boxes(k), padded, 0, 6)
        WideTree.pad(padded, 0)
        WideTree.writeBox(whole.update)(0, k, width, padded)
      else WideTree.writeEmpty(whole.update)(0, k, width)
    nodes ++= whole
    loop(count): k =>
      val parent = boxes(k) & -BinaryTree.NodeFloats
      val side = if boxes(k) == parent then 0 else 1
      val child = tree.child(parent, side)
      val codeAt = at + 6 * width + k
      if child >= 0 && partSize > 0 && tree.count(child) <= partSize then
        later += WideWriter.Later(child, codeAt)
      else
        val code = write(child, tree.leafSize(parent, side))
        nodes(codeAt) = java.lang.Float.intBitsToFloat(code)
    at

  /** Appends the children of `binary`, with `left` of `k` in its left subtree. */
  private def gather(binary: Int, left: Int, k: Int, boxes: Array[Int], count: Int): Int =
    val attached = collapseChild(binary, 0, left, boxes, count)
    collapseChild(binary, 1, k - left, boxes, attached)

  private def collapseChild(parent: Int, side: Int, most: Int, boxes: Array[Int], count: Int): Int =
    val child = tree.child(parent, side)
    var k = most
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
  final class Later(val node: Int, val codeAt: Int)
