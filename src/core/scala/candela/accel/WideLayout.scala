package candela.accel

import candela.concurrency.Parallel
import candela.geometry.Bounds3

/** A [[WideTree]] without its primitives: it depends on the corners of triangles and the boxes of
  * all others alone, and so serves all primitives in which these are equal. Immutable.
  *
  * @param order primitives outside blocks, by slot
  */
private[accel] final class WideLayout(
    val width: Int,
    val lanes: Int,
    val count: Int,
    val bounds: Bounds3,
    val nodes: Array[Float],
    val root: Int,
    val blocks: Array[Float],
    val order: Array[Int]
):
  /** The hierarchy of primitives that it fits. */
  def withPrimitives(primitives: Primitives, parallel: Parallel): WideTree =
    val packed = primitives.packed(order, parallel)
    val masked = primitives.maskedTriangles
    WideTree(width, lanes, count, bounds, nodes, root, blocks, packed, masked)

  /** A layout of the primitives of both, below a new root. */
  def joined(other: WideLayout): WideLayout =
    val top = WideTree.floats(width)
    val joinedNodes = new Array[Float](top + nodes.length + other.nodes.length)
    System.arraycopy(nodes, 0, joinedNodes, top, nodes.length)
    System.arraycopy(other.nodes, 0, joinedNodes, top + nodes.length, other.nodes.length)
    val relocation = Relocation(top, 0, 0)
    val otherRelocation = Relocation(
      top + nodes.length,
      blocks.length / WideTree.blockFloats(lanes),
      order.length
    )
    relocation.relocate(joinedNodes, top, top + nodes.length, width)
    otherRelocation.relocate(joinedNodes, top + nodes.length, joinedNodes.length, width)
    var lane = 0
    while lane < width do
      WideTree.writeEmpty(joinedNodes.update)(0, lane, width)
      lane += 1
    write(joinedNodes, 0, relocation.moved(root))
    other.write(joinedNodes, 1, otherRelocation.moved(other.root))
    WideLayout(
      width,
      lanes,
      count + other.count,
      bounds.union(other.bounds),
      joinedNodes,
      0,
      Array.concat(blocks, other.blocks),
      Array.concat(order, other.order)
    )

  /** Writes its box and code as a child of the first node. */
  private def write(to: Array[Float], lane: Int, code: Int): Unit =
    if code != WideTree.NoChild then
      val (low, high) = (bounds.min, bounds.max)
      val box = Array(low.x, low.y, low.z, high.x, high.y, high.z)
      WideTree.pad(box, 0)
      WideTree.writeBox(to.update)(0, lane, width, box)
      to(6 * width + lane) = java.lang.Float.intBitsToFloat(code)

/** By how much the children of nodes move when a tree becomes part of a larger one: Floats of
  * nodes, blocks, and slots.
  */
private[accel] final class Relocation(nodeFloats: Int, blocks: Int, slots: Int):
  def moved(code: Int): Int =
    if code == WideTree.NoChild then code
    else if code >= 0 then code + nodeFloats
    else
      val isBlock = WideTree.isBlock(code)
      val start = if isBlock then blocks else slots
      WideTree.leaf(isBlock, WideTree.leafStart(code) + start, WideTree.size(code))

  /** Relocates the children of all nodes in a range. */
  def relocate(nodes: Array[Float], from: Int, until: Int, width: Int): Unit =
    var node = from
    while node < until do
      var slot = node + 6 * width
      val end = slot + width
      while slot < end do
        val code = java.lang.Float.floatToRawIntBits(nodes(slot))
        nodes(slot) = java.lang.Float.intBitsToFloat(moved(code))
        slot += 1
      node += WideTree.floats(width)
