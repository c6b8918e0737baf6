package candela.accel

import candela.base.loop
import candela.geometry.Bounds3

/** Nodes and leaves of a wide BVH with a SIMD layout, in flat arrays.
  *
  * A node is six rows of `width` Floats (its children's min x, y, z, max x, y, z) and a row of raw
  * bits, the children themselves: one load per row and slab. A child ≥ 0 is the index of its node's
  * first Float. A child below 0 is the complement of a leaf (see [[WideTree.leaf]]): a block of up
  * to `lanes` triangles, or up to 16 consecutive primitives of any kind.
  *
  * A block is nine rows of `lanes` Floats, x, y, z of the triangles' three corners, and a row of
  * raw bits, their primitive numbers. All boxes are slightly larger than their contents: see
  * [[WideTree.pad]].
  *
  * Source of the layout: Wald, Benthin, Boulos, "Getting Rid of Packets", RT 2008.
  *
  * @param width  branching factor
  * @param lanes  triangles per block
  * @param count  total number of primitives
  * @param root   encoded as a child
  * @param unblocked primitives outside blocks
  * @param masked test those triangles, if any has a mask
  */
private[accel] final class WideTree(
    val width: Int,
    val lanes: Int,
    val count: Int,
    val bounds: Bounds3,
    val nodes: Array[Float],
    val root: Int,
    val blocks: Array[Float],
    val unblocked: PackedPrimitives,
    val masked: MaskedTriangles
):
  val isMasked: Boolean = !masked.isEmpty

  /** The most entries of a traversal's stack: of each level of nodes, all children but one wait. */
  val stackSize: Int = WideTree.levels(nodes, width) * (width - 1) + 1

  def nodeCount: Int = nodes.length / WideTree.floats(width)
  def blockCount: Int = blocks.length / WideTree.blockFloats(lanes)

private[accel] object WideTree:
  /** Pads a box of six Floats by the tolerance of hits, and by one Float more to keep corners off
    * its planes: a ray within a plane has no distance to it.
    */
  def pad(boxes: Array[Float], at: Int): Unit =
    var axis = at
    while axis < at + 3 do
      val low = boxes(axis)
      val high = boxes(axis + 3)
      val padding = (high - low) * Pad
      boxes(axis) = Math.nextDown(low - padding)
      boxes(axis + 3) = Math.nextUp(high + padding)
      axis += 1

  /** Levels of nodes, of which each is before its children. */
  private def levels(nodes: Array[Float], width: Int): Int =
    val above = new Array[Byte](nodes.length / floats(width))
    var maxLevel = -1
    loop(above.length): i =>
      val children = i * floats(width) + 6 * width
      if above(i) > maxLevel then maxLevel = above(i)
      loop(width): k =>
        val child = java.lang.Float.floatToRawIntBits(nodes(children + k))
        if child > 0 then above(child / floats(width)) = (above(i) + 1).toByte
    maxLevel + 1

  /** Writes the box of a node's child, six Floats, min and max.
    *
    * @param node index of the node's first Float
    */
  inline def writeBox(inline put: (Int, Float) => Unit)(
      node: Int,
      lane: Int,
      width: Int,
      box: Array[Float]
  ): Unit =
    var row = 0
    while row < 6 do
      put(node + row * width + lane, box(row))
      row += 1

  /** Writes a child that every ray misses: it begins at infinity or ends behind the origin. */
  inline def writeEmpty(inline put: (Int, Float) => Unit)(node: Int, lane: Int, width: Int): Unit =
    var row = 0
    while row < 6 do
      put(node + row * width + lane, Float.PositiveInfinity)
      row += 1
    put(node + 6 * width + lane, java.lang.Float.intBitsToFloat(NoChild))

  /** Twice the tolerance of [[candela.shapes.TriangleTest.BoxTolerance]]. */
  private final val Pad = 4e-6f

  inline def floats(width: Int): Int = 7 * width
  inline def blockFloats(lanes: Int): Int = 10 * lanes

  /** Encodes a leaf: 26 bits of index (a block, or the first slot of `unblocked`), 4 bits of count
    * minus one, 1 bit of kind.
    */
  def leaf(isBlock: Boolean, first: Int, count: Int): Int =
    ~((first << 5) | ((count - 1) << 1) | (if isBlock then 1 else 0))

  inline def isBlock(leaf: Int): Boolean = (~leaf & 1) != 0
  inline def size(leaf: Int): Int = ((~leaf >> 1) & 15) + 1
  inline def leafStart(leaf: Int): Int = ~leaf >>> 5

  /** Encodes an empty child; visited only as a root. */
  final val NoChild = -2147483648
