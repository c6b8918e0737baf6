package candela.accel.building

import candela.accel.{BinaryTree, Primitives, WideTree}
import candela.base.{loop, FloatBuffer, IntBuffer, Parallel}
import candela.shapes.TriangleSoup

/** Makes nodes and leaves of a [[WideTree]] from the binary tree that [[BvhBuilder]] makes, as a
  * [[CollapsePlan]] finds best.
  *
  * One thread writes the upper part; below it each writes whole subtrees, which are put behind it
  * in their order. How many there are depends on the number of primitives alone, so all is the
  * same, bit for bit, for any number of threads.
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
    if code == WideTree.NoChild then code
    else if code >= 0 then code + nodeStarts(i)
    else
      val isBlock = WideTree.isBlock(code)
      val start = if isBlock then ownerStarts(i) / lanes else otherStarts(i)
      WideTree.leaf(isBlock, WideTree.first(code) + start, WideTree.size(code))

private[accel] object WideBuilder:

  /** @param maxLeaf of the binary tree that it is made of, but for triangles */
  def of(
      primitives: Primitives,
      width: Int,
      lanes: Int,
      maxLeaf: Int,
      parallel: Parallel
  ): WideTree =
    val size = LeafSize(maxLeaf, lanes, primitives.isSolidTriangle)
    val built = BvhBuilder.of(primitives, size, parallel)
    val wide = WideBuilder(width, lanes, built, primitives.isSolidTriangle, parallel)
    WideTree(
      width,
      lanes,
      primitives.count,
      built.bounds,
      wide.nodes,
      wide.rootCode,
      blocks(primitives.soup, wide.owners, lanes, parallel),
      primitives.packed(wide.others, parallel)
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

/** Writes the nodes and leaves of a [[WideTree]] or of a part of one, as a [[CollapsePlan]] says.
  * Belongs to one thread. All numbers in its codes count from its own first node, block or slot.
  *
  * @param partSize subtrees of at most so many primitives are left for later; 0: none
  */
private[building] final class WideWriter(
    width: Int,
    lanes: Int,
    tree: BinaryTree,
    plan: CollapsePlan,
    partSize: Int
):
  val nodes = FloatBuffer()

  /** Which primitives are in the lanes of the blocks; −1: none. */
  val owners = IntBuffer()

  /** Which primitives are in the leaves that are no blocks. */
  val others = IntBuffer()

  private val padded = new Array[Float](6)

  /** What was left for later, and where its code is to be put. */
  val later = scala.collection.mutable.ArrayBuffer.empty[WideWriter.Later]

  /** Writes what becomes of a binary node or, below 0, of a leaf with `size` primitives; answers
    * its code.
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

  /** The node that takes the place of this binary one, and all below it. */
  private def node(binary: Int): Int =
    val at = nodes.length
    loop(WideTree.floats(width))(_ => nodes += 0f)
    val boxes = new Array[Int](width) // of the children: where in the tree's nodes
    val count = gather(binary, plan.choice(binary, 1), width, boxes, 0)
    var k = 0
    while k < width do
      if k < count then
        val parent = boxes(k) & -BinaryTree.NodeFloats
        val side = if boxes(k) == parent then 0 else 1
        writeBox(at, k, boxes(k))
        val child = tree.child(parent, side)
        val codeAt = at + 6 * width + k
        if child >= 0 && partSize > 0 && tree.count(child) <= partSize then
          later += WideWriter.Later(child, codeAt)
        else
          val code = write(child, tree.leafSize(parent, side))
          nodes(codeAt) = java.lang.Float.intBitsToFloat(code)
      else writeEmpty(at, k)
      k += 1
    at

  /** Appends the children that `binary` has if `left` of `k` are in its left half. */
  private def gather(binary: Int, left: Int, k: Int, boxes: Array[Int], count: Int): Int =
    val some = hang(binary, 0, left, boxes, count)
    hang(binary, 1, k - left, boxes, some)

  private def hang(parent: Int, side: Int, most: Int, boxes: Array[Int], count: Int): Int =
    val child = tree.child(parent, side)
    var k = most
    if child >= 0 then while k > 1 && plan.choice(child, k) == 0 do k -= 1
    if child < 0 || k == 1 then
      boxes(count) = parent + 6 * side
      count + 1
    else gather(child, plan.choice(child, k), k, boxes, count)

  private def writeBox(at: Int, lane: Int, box: Int): Unit =
    System.arraycopy(tree.nodes, box, padded, 0, 6)
    WideTree.pad(padded, 0)
    loop(6)(row => nodes(at + row * width + lane) = padded(row))

  /** Met by no ray: it begins at infinity or lies behind. */
  private def writeEmpty(at: Int, lane: Int): Unit =
    var row = 0
    while row < 6 do
      nodes(at + row * width + lane) = Float.PositiveInfinity
      row += 1
    nodes(at + 6 * width + lane) = java.lang.Float.intBitsToFloat(WideTree.NoChild)

private[building] object WideWriter:

  /** A binary node whose subtree is still to be written.
    *
    * @param codeAt where its code is to be put
    */
  final class Later(val node: Int, val codeAt: Int)
