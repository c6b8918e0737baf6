package candela.accel.building

import candela.base.loop
import candela.concurrency.Parallel
import candela.accel.BinaryTree

/** Plans the collapse of a binary BVH into a [[candela.accel.WideTree]]: selects the subtrees that
  * become leaves and the nodes that merge into their ancestors, to minimise the expected cost of a
  * ray.
  *
  * Computes for each subtree the minimum cost of representing it as 1, 2, … `width` children. The
  * cost for k is the best split of k between its two children; the cost for 1 is a leaf or a node
  * of `width` children. Source: Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs
  * Through Compressed Wide BVHs", HPG 2017, §3.1.
  *
  * The lower parts of the tree are evaluated in parallel, each by one thread, then the rest above
  * them.
  *
  * @param width      branching factor
  * @param lanes      triangles per block
  * @param isTriangle whether a primitive may be tested in a block
  */
private[building] final class CollapsePlan(
    width: Int,
    lanes: Int,
    tree: BinaryTree,
    isTriangle: Int => Boolean,
    parallel: Parallel
):
  import CollapsePlan.*

  /** Choice for each binary node and k children: 0 to keep that for k − 1 (or a leaf, if k is 1);
    * otherwise the number of the k children in its left subtree.
    */
  private val choices = new Array[Byte](Math.multiplyExact(tree.nodeCount, width))

  def choice(node: Int, k: Int): Int = choices(node / BinaryTree.NodeFloats * width + k - 1)

  /** Whether these slots of the tree's order may form one block. */
  def isBlock(first: Int, end: Int): Boolean =
    var i = first
    while i < end && isTriangle(tree.order(i)) do i += 1
    i == end && end - first <= lanes

  if tree.root >= 0 then
    val roots = partsBelow(tree.root, tree.rootArea)
    val priced = new Array[Priced](roots.length)
    parallel.forEach(roots.length): i =>
      val pricer = Pricer(Vector.empty)
      val count = pricer.price(roots(i).node, roots(i).area, 0)
      priced(i) = Priced(roots(i).node, count, Array.tabulate(width + 1)(pricer.cost(0, _)))
    Pricer(priced.toVector).price(tree.root, tree.rootArea, 0): Unit

  private def partSize = BvhBuilder.partSize(tree.order.length)

  /** Subtrees for one thread each, in traversal order. */
  private def partsBelow(node: Int, area: Float): Vector[Part] =
    if tree.count(node) <= partSize then Vector(Part(node, area))
    else
      Vector(0, 1).flatMap: side =>
        val child = tree.child(node, side)
        if child < 0 then Vector.empty else partsBelow(child, tree.area(node + 6 * side))

  /** @param done subtrees evaluated already, in traversal order */
  private final class Pricer(done: Vector[Priced]):
    private var nextDone = 0

    /** Costs of a subtree as 1, 2, … children, for each level of the recursion. */
    private val costs = FloatStack(width)

    def cost(level: Int, k: Int): Float = costs(level, k)

    /** Fills level `level` of `costs` and the choices of the subtree; returns its number of
      * triangles, or a very large number if it contains other primitives.
      */
    def price(node: Int, area: Float, level: Int): Int =
      if nextDone < done.length && done(nextDone).node == node then
        val priced = done(nextDone)
        nextDone += 1
        loop(width)(i => costs(level, i + 1) = priced.costs(i + 1))
        priced.count
      else
        val leftCount = priceChild(node, 0, level + 1)
        costs.copyRow(level + 1, level)
        val rightCount = priceChild(node, 1, level + 1)
        val count = if leftCount >= NotABlock || rightCount >= NotABlock then NotABlock
        else leftCount + rightCount
        choose(node, area, level, count)
        count

    /** Level `level` holds the left child's costs, the next level the right child's. */
    private def choose(node: Int, area: Float, level: Int, count: Int): Unit =
      val offset = node / BinaryTree.NodeFloats * width
      var split = 0
      var k = 2
      while k <= width do
        var minCost = Float.PositiveInfinity
        split = 0
        var i = 1
        while i < k do
          val cost = costs(level, i) + costs(level + 1, k - i)
          if cost < minCost || split == 0 then // also where all costs are infinite
            minCost = cost
            split = i
          i += 1
        costs.undecided(k) = minCost
        choices(offset + k - 1) = split.toByte
        k += 1
      val asNode = area * NodeCost + costs.undecided(width)
      val asLeaf = area * BlockCost
      val isLeaf = count <= lanes && asLeaf <= asNode
      choices(offset) = if isLeaf then 0 else split.toByte
      costs(level, 1) = if isLeaf then asLeaf else asNode
      k = 2
      while k <= width do
        if costs.undecided(k) < costs(level, k - 1) then costs(level, k) = costs.undecided(k)
        else
          costs(level, k) = costs(level, k - 1)
          choices(offset + k - 1) = 0
        k += 1

    private def priceChild(node: Int, side: Int, level: Int): Int =
      val child = tree.child(node, side)
      val area = tree.area(node + 6 * side)
      if child >= 0 then price(child, area, level)
      else
        val count = tree.leafSize(node, side)
        val isOne = isBlock(~child, ~child + count)
        costs.fill(level, area * (if isOne then BlockCost else count * OtherCost))
        if isOne then count else NotABlock

private[building] object CollapsePlan:
  /** Costs of a node, a triangle block, and each other primitive: only ratios matter. */
  inline val NodeCost = 1f
  inline val BlockCost = 1f
  inline val OtherCost = 2f

  /** Stands for the count of triangles where they do not fit into a block. */
  private final val NotABlock = 1000000000

  private final class Part(val node: Int, val area: Float)

  /** @param count number of triangles, or very large
    * @param costs as 1, 2, … children
    */
  private final class Priced(val node: Int, val count: Int, val costs: Array[Float])

/** Rows of Floats indexed from 1, one for each level of a recursion. */
private[building] final class FloatStack(width: Int):
  private val rows = new Array[Float](130 * (width + 1))

  /** Row for undecided choices. */
  val undecided = new Array[Float](width + 1)

  def apply(level: Int, k: Int): Float = rows(level * (width + 1) + k)
  def update(level: Int, k: Int, x: Float): Unit = rows(level * (width + 1) + k) = x
  def copyRow(from: Int, to: Int): Unit =
    System.arraycopy(rows, from * (width + 1), rows, to * (width + 1), width + 1)
  def fill(level: Int, x: Float): Unit =
    java.util.Arrays.fill(rows, level * (width + 1), (level + 1) * (width + 1), x)
