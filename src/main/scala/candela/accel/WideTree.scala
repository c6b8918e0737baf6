package candela.accel

import candela.geometry.Bounds3

/** A hierarchy of many children a node, made for vectors, all in flat arrays.
  *
  * A node is six rows of `width` Floats (its children's min x, y, z, max x, y, z) and a row of raw
  * bits, the children themselves: one load a row and slab. A child ≥ 0 is the index of its node's
  * first Float. Below 0 it is the complement of a leaf (see [[WideTree.leaf]]): up to `lanes`
  * triangles in a block, or up to 16 primitives of any kind in a row.
  *
  * A block is nine rows of `lanes` Floats, x, y, z of the triangles' three corners, and a row of
  * raw bits, their numbers. All boxes are somewhat larger than what is in them: see
  * [[WideTree.pad]].
  *
  * Source of the layout: Wald, Benthin, Boulos, "Getting Rid of Packets", RT 2008.
  *
  * @param width  children a node
  * @param lanes  triangles a block
  * @param count  of all primitives
  * @param root   a child's code
  * @param others the primitives that are in no block
  */
private[accel] final class WideTree(
    val width: Int,
    val lanes: Int,
    val count: Int,
    val bounds: Bounds3,
    val nodes: Array[Float],
    val root: Int,
    val blocks: Array[Float],
    val others: PackedPrimitives
):
  def nodeCount: Int = nodes.length / WideTree.floats(width)
  def blockCount: Int = blocks.length / WideTree.blockFloats(lanes)

private[accel] object WideTree:
  /** Widens a box, six Floats: to as far beside it as hits may be, and one Float more, so that no
    * corner is on its planes: there, a ray along the plane has no distance.
    */
  def pad(boxes: Array[Float], at: Int): Unit =
    var axis = at
    while axis < at + 3 do
      val low = boxes(axis)
      val high = boxes(axis + 3)
      val more = (high - low) * Pad
      boxes(axis) = Math.nextDown(low - more)
      boxes(axis + 3) = Math.nextUp(high + more)
      axis += 1

  /** Twice what [[candela.shapes.TriangleTest.Within]] allows. */
  private final val Pad = 4e-6f

  inline def floats(width: Int): Int = 7 * width
  inline def blockFloats(lanes: Int): Int = 10 * lanes

  /** The code of a leaf: 26 bits of where (a block, or the first slot of `others`), 4 bits of how
    * many less one, 1 bit of which kind.
    */
  def leaf(isBlock: Boolean, first: Int, count: Int): Int =
    ~((first << 5) | ((count - 1) << 1) | (if isBlock then 1 else 0))

  inline def isBlock(leaf: Int): Boolean = (~leaf & 1) != 0
  inline def size(leaf: Int): Int = ((~leaf >> 1) & 15) + 1
  inline def first(leaf: Int): Int = ~leaf >>> 5

  /** The code of no child at all: never arrived at, but as a root. */
  final val NoChild = -2147483648
