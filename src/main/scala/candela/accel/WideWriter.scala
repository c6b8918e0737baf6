package candela.accel

/** Writes the nodes and leaves of a [[WideTree]] or of a part of one, as a [[CollapsePlan]] says.
  * Belongs to one thread. All numbers in its codes count from its own first node, block or slot.
  *
  * @param partSize subtrees of at most so many primitives are left for later; 0: none
  * @param expected how many primitives are in it
  */
private[accel] final class WideWriter(
    width: Int,
    lanes: Int,
    tree: BvhBuilder,
    plan: CollapsePlan,
    partSize: Int,
    expected: Int
):
  val nodes = FloatBuffer((expected / lanes * 2 / width + 1) * WideTree.floats(width))

  /** Which primitives are in the lanes of the blocks; −1: none. */
  val owners = IntBuffer(expected + expected / 4)

  /** Which primitives are in the leaves that are no blocks. */
  val others = IntBuffer(16)

  /** The most entries that a walk's stack can have. */
  var stackNeed = 0

  /** What was left for later, and where its code is to be put. */
  val later = scala.collection.mutable.ArrayBuffer.empty[WideWriter.Later]

  /** Writes what becomes of a binary node or, below 0, of a leaf with `size` primitives; answers
    * its code.
    *
    * @param waiting entries on a walk's stack when it comes here
    */
  def write(code: Int, size: Int, waiting: Int): Int =
    if code < 0 then leaf(~code, ~code + size)
    else if plan.choice(code, 1) == 0 then leaf(tree.firstSlot(code), tree.endSlot(code))
    else node(code, waiting)

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
  private def node(binary: Int, waiting: Int): Int =
    val at = nodes.grow(WideTree.floats(width))
    val boxes = new Array[Int](width) // of the children: where in the tree's nodes
    val count = gather(binary, plan.choice(binary, 1), width, boxes, 0)
    stackNeed = Math.max(stackNeed, waiting + count)
    var k = 0
    while k < width do
      if k < count then
        val parent = boxes(k) & -BvhBuilder.NodeFloats
        val side = if boxes(k) == parent then 0 else 1
        writeBox(at, k, boxes(k))
        val child = tree.child(parent, side)
        val codeAt = at + 6 * width + k
        if child >= 0 && partSize > 0 && tree.count(child) <= partSize then
          later += WideWriter.Later(child, waiting + count - 1, codeAt)
        else
          val code = write(child, tree.leafSize(parent, side), waiting + count - 1)
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
    var axis = 0
    while axis < 3 do
      nodes(at + axis * width + lane) = tree.nodes(box + axis)
      nodes(at + (3 + axis) * width + lane) = tree.nodes(box + 3 + axis)
      axis += 1
    WideTree.pad(nodes.floats, at + lane, width)

  /** Met by no ray: it begins at infinity or lies behind. */
  private def writeEmpty(at: Int, lane: Int): Unit =
    var row = 0
    while row < 6 do
      nodes(at + row * width + lane) = Float.PositiveInfinity
      row += 1
    nodes(at + 6 * width + lane) = java.lang.Float.intBitsToFloat(WideTree.Nothing)

private[accel] object WideWriter:

  /** A binary node whose subtree is still to be written.
    *
    * @param waiting entries on a walk's stack when it comes there
    * @param codeAt  where its code is to be put
    */
  final class Later(val node: Int, val waiting: Int, val codeAt: Int)
