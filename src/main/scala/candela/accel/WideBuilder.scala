package candela.accel

/** Makes a [[WideTree]] of the binary one that [[BvhBuilder]] leaves: decides which subtrees become
  * leaves and which nodes vanish into those above, so that the expected cost of a ray is least.
  *
  * Each subtree is asked what it costs at least to hang it up as 1, 2, … `width` children. The
  * answer for k is the best division of k among its two halves, the answer for 1 a leaf or a node
  * of `width` children. Source: Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs
  * Through Compressed Wide BVHs", HPG 2017, §3.1.
  *
  * @param width children a node
  * @param lanes triangles a block
  * @param nodes, order as of a BvhBuilder; `root` and `rootCount`, too
  * @param isTriangle   may this primitive be tested in a block?
  */
private[accel] final class WideBuilder(
    width: Int,
    lanes: Int,
    nodes: Array[Float],
    nodeCount: Int,
    order: Array[Int],
    root: Int,
    rootCount: Int,
    isTriangle: Int => Boolean
):
  /** For each binary node and k children: 0, as for k − 1 (or a leaf, if k is 1); otherwise how
    * many of the k go to its left half.
    */
  private val choices = new Array[Byte](nodeCount * width)

  /** The costs of a subtree as 1, 2, … children, for each level of the recursion. */
  private val costs = new FloatStack(width)

  private val wide = FloatBuffer(nodeCount / 3 * WideTree.floats(width))

  /** Which primitives are in the lanes of the blocks; −1: none. */
  val owners = IntBuffer(order.length + order.length / 4)

  /** Which primitives are in the leaves that are no blocks. */
  val others = IntBuffer(16)

  /** The most entries that a walk's stack can have. */
  var stackNeed = 0

  /** A child's code as in a [[WideTree]]. */
  val rootCode: Int =
    if order.length == 0 then WideTree.Nothing
    else if root < 0 then leaf(~root, ~root + rootCount)
    else
      price(root, rootArea, 0): Unit
      if choice(root, 1) == 0 then leaf(firstSlot(root), endSlot(root)) else node(root, 0)

  def wideNodes: Array[Float] = wide.toArray

  private def bits(at: Int): Int = java.lang.Float.floatToRawIntBits(nodes(at))
  private def choice(node: Int, k: Int): Int =
    choices(node / BvhBuilder.NodeFloats * width + k - 1)

  private def rootArea: Float =
    def side(k: Int) =
      Math.max(nodes(root + 3 + k), nodes(root + 9 + k)) -
        Math.min(nodes(root + k), nodes(root + 6 + k))
    side(0) * side(1) + side(1) * side(2) + side(2) * side(0)

  private def area(at: Int): Float =
    val x = nodes(at + 3) - nodes(at)
    val y = nodes(at + 4) - nodes(at + 1)
    val z = nodes(at + 5) - nodes(at + 2)
    x * y + y * z + z * x

  /** Fills level `level` of `costs` and the choices of the subtree; answers how many triangles are
    * in it, or very many if there is anything else.
    */
  private def price(node: Int, area: Float, level: Int): Int =
    val left = priceChild(node, 0, level + 1)
    costs.keep(level + 1, level)
    val right = priceChild(node, 1, level + 1)
    val count = if left >= Many || right >= Many then Many else left + right
    val at = node / BvhBuilder.NodeFloats * width
    var split = 0
    var k = 2
    // Level `level` holds the left half's costs, the next one the right half's
    while k <= width do
      var best = Float.PositiveInfinity
      split = 0
      var i = 1
      while i < k do
        val cost = costs(level, i) + costs(level + 1, k - i)
        if cost < best || split == 0 then // also where all costs are infinite
          best = cost
          split = i
        i += 1
      costs.found(k) = best
      choices(at + k - 1) = split.toByte
      k += 1
    val asNode = area * WideBuilder.NodeCost + costs.found(width)
    val asLeaf = area * WideBuilder.BlockCost
    val isLeaf = count <= lanes && asLeaf <= asNode
    choices(at) = if isLeaf then 0 else split.toByte
    costs(level, 1) = if isLeaf then asLeaf else asNode
    k = 2
    while k <= width do
      if costs.found(k) < costs(level, k - 1) then costs(level, k) = costs.found(k)
      else
        costs(level, k) = costs(level, k - 1)
        choices(at + k - 1) = 0
      k += 1
    count

  private def priceChild(node: Int, side: Int, level: Int): Int =
    val child = bits(node + 12 + side)
    val its = area(node + 6 * side)
    if child >= 0 then price(child, its, level)
    else
      val count = bits(node + 14 + side)
      val isBlock = isPlain(~child, ~child + count)
      costs.fill(
        level,
        its * (if isBlock then WideBuilder.BlockCost else count * WideBuilder.OtherCost)
      )
      if isBlock then count else Many

  private def isPlain(first: Int, end: Int): Boolean =
    var i = first
    while i < end && isTriangle(order(i)) do i += 1
    i == end && end - first <= lanes

  private def firstSlot(node: Int): Int =
    val left = bits(node + 12)
    if left < 0 then ~left else firstSlot(left)

  private def endSlot(node: Int): Int =
    val right = bits(node + 13)
    if right < 0 then ~right + bits(node + 15) else endSlot(right)

  private def leaf(first: Int, end: Int): Int =
    if isPlain(first, end) then
      val block = owners.length / lanes
      var i = 0
      while i < lanes do
        owners += (if first + i < end then order(first + i) else -1)
        i += 1
      WideTree.leaf(isBlock = true, block, end - first)
    else
      val at = others.length
      var i = first
      while i < end do
        others += order(i)
        i += 1
      WideTree.leaf(isBlock = false, at, end - first)

  /** Writes the node that takes the place of this binary one, and all below it. */
  private def node(binary: Int, waiting: Int): Int =
    val at = wide.grow(WideTree.floats(width))
    val boxes = new Array[Int](width) // of the children: where in `nodes`
    val count = gather(binary, choice(binary, 1), width, boxes, 0)
    stackNeed = Math.max(stackNeed, waiting + count)
    var k = 0
    while k < width do
      if k < count then
        val parent = boxes(k) & -BvhBuilder.NodeFloats
        val side = if boxes(k) == parent then 0 else 1
        val child = bits(parent + 12 + side)
        val code =
          if child < 0 then leaf(~child, ~child + bits(parent + 14 + side))
          else if choice(child, 1) == 0 then leaf(firstSlot(child), endSlot(child))
          else node(child, waiting + count - 1)
        write(at, k, boxes(k), code)
      else writeEmpty(at, k)
      k += 1
    at

  /** Appends the children that `binary` has if `left` of `k` are in its left half. */
  private def gather(binary: Int, left: Int, k: Int, boxes: Array[Int], count: Int): Int =
    val some = hang(binary, 0, left, boxes, count)
    hang(binary, 1, k - left, boxes, some)

  private def hang(parent: Int, side: Int, most: Int, boxes: Array[Int], count: Int): Int =
    val child = bits(parent + 12 + side)
    var k = most
    if child >= 0 then while k > 1 && choice(child, k) == 0 do k -= 1
    if child < 0 || k == 1 then
      boxes(count) = parent + 6 * side
      count + 1
    else gather(child, choice(child, k), k, boxes, count)

  private def write(at: Int, lane: Int, box: Int, code: Int): Unit =
    var axis = 0
    while axis < 3 do
      wide(at + axis * width + lane) = nodes(box + axis)
      wide(at + (3 + axis) * width + lane) = nodes(box + 3 + axis)
      axis += 1
    WideTree.pad(wide.floats, at + lane, width)
    wide(at + 6 * width + lane) = java.lang.Float.intBitsToFloat(code)

  /** Met by no ray: it begins at infinity or lies behind. */
  private def writeEmpty(at: Int, lane: Int): Unit =
    var row = 0
    while row < 6 do
      wide(at + row * width + lane) = Float.PositiveInfinity
      row += 1
    wide(at + 6 * width + lane) = java.lang.Float.intBitsToFloat(WideTree.Nothing)

  private def Many = WideBuilder.Many

private[accel] object WideBuilder:
  /** What a node costs, a block of triangles, and each other primitive: only ratios count. */
  inline val NodeCost = 1f
  inline val BlockCost = 1f
  inline val OtherCost = 2f

  private final val Many = 1000000000
