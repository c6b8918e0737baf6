package candela.accel

import candela.geometry.Bounds3

/** Nodes of a binary BVH, in flat arrays.
  *
  * A node is 16 Floats (one cache line): the left child's box (min x y z, max x y z), the right
  * child's box, then as raw bits the left child, the right child, and their primitive counts if
  * they are leaves. A child ≥ 0 is the index of its node's first Float; a child below 0 is a leaf
  * whose first slot is its complement. Each node stores both children's boxes, so traversal tests
  * them from one cache line and visits no node in vain.
  *
  * @param order     primitives in leaf order
  * @param root      encoded as a child
  * @param rootCount number of primitives in the root, if it is a leaf
  * @param bounds    bounds of all primitives
  */
private[accel] final class BinaryTree(
    val order: Array[Int],
    val nodes: Array[Float],
    val root: Int,
    val rootCount: Int,
    val bounds: Bounds3
):
  def nodeCount: Int = nodes.length / BinaryTree.NodeFloats

  private def bits(at: Int): Int = java.lang.Float.floatToRawIntBits(nodes(at))
  def child(node: Int, side: Int): Int = bits(node + 12 + side)
  def leafSize(node: Int, side: Int): Int = bits(node + 14 + side)

  /** First slot of `order` in the subtree. */
  def firstSlot(node: Int): Int =
    val leftChild = child(node, 0)
    if leftChild < 0 then ~leftChild else firstSlot(leftChild)

  def endSlot(node: Int): Int =
    val rightChild = child(node, 1)
    if rightChild < 0 then ~rightChild + leafSize(node, 1) else endSlot(rightChild)

  /** Number of primitives in the subtree. */
  def count(node: Int): Int = endSlot(node) - firstSlot(node)

  /** Half the surface area of the box at offset `at` of `nodes`. */
  def area(at: Int): Float =
    val x = nodes(at + 3) - nodes(at)
    val y = nodes(at + 4) - nodes(at + 1)
    val z = nodes(at + 5) - nodes(at + 2)
    x * y + y * z + z * x

  def rootArea: Float =
    def side(k: Int) =
      Math.max(nodes(root + 3 + k), nodes(root + 9 + k)) -
        Math.min(nodes(root + k), nodes(root + 6 + k))
    side(0) * side(1) + side(1) * side(2) + side(2) * side(0)

private[accel] object BinaryTree:
  inline val NodeFloats = 16
