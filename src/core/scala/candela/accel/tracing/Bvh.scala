package candela.accel.tracing

import candela.concurrency.Parallel
import candela.accel.{Accelerator, BinaryTree, Primitives, WideTree}
import candela.accel.building.{BvhBuilder, LeafSize}
import candela.geometry.{Bounds3, Hit, Ray}

/** A binary BVH: the reference implementation of [[WideBvh]], and the fallback for primitive counts
  * beyond its limit.
  *
  * Source of the traversal: Aila and Laine, "Understanding the Efficiency of Ray Traversal on
  * GPUs", HPG 2009.
  */
final class Bvh(
    primitives: Primitives,
    maxLeaf: Int = 4,
    parallel: Parallel = Parallel.Alone
) extends Accelerator:
  private val tree = BvhBuilder.of(primitives, LeafSize.single(maxLeaf), parallel)
  private val packed = primitives.packed(tree.order, parallel)
  private val nodes = tree.nodes
  parallel.ranges(tree.nodeCount): (from, until) =>
    for i <- from until until; side <- 0 until 2 do
      WideTree.pad(nodes, BinaryTree.NodeFloats * i + 6 * side)
  private val root = tree.root
  private val rootCount = tree.rootCount
  val bounds: Bounds3 = tree.bounds

  def describe: String =
    s"bvh: ${primitives.count} primitives, ${nodes.length / BinaryTree.NodeFloats} nodes"

  def closest(ray: Ray, hit: Hit): Boolean =
    hit.primitive = -1
    traverse(ray, hit, anyHit = false)

  def isOccluded(ray: Ray, hit: Hit): Boolean = traverse(ray, hit, anyHit = true)

  private inline def bits(at: Int): Int = java.lang.Float.floatToRawIntBits(nodes(at))

  private inline def traverse(ray: Ray, hit: Hit, inline anyHit: Boolean): Boolean =
    val b = nodes
    val stack = ray.stack(Bvh.StackSize)
    val ox = ray.ox
    val oy = ray.oy
    val oz = ray.oz
    val ix = ray.invX
    val iy = ray.invY
    val iz = ray.invZ
    // Offsets of the near and far planes of each axis within a box
    val nx = if ix < 0f then 3 else 0
    val ny = if iy < 0f then 4 else 1
    val nz = if iz < 0f then 5 else 2
    val fx = 3 - nx
    val fy = 5 - ny
    val fz = 7 - nz
    var hasHit = false
    var top = 0
    var node = root
    var leafSize = rootCount
    var going = primitives.count > 0
    while going do
      if node >= 0 then
        // Comparisons with `if` ignore the NaN of 0·∞ (origin on a slab plane): the slab counts as
        // hit
        var tNear = 0f
        var tFar = ray.tMax * Bvh.FarSlack
        var t = (b(node + nx) - ox) * ix
        if t > tNear then tNear = t
        t = (b(node + ny) - oy) * iy
        if t > tNear then tNear = t
        t = (b(node + nz) - oz) * iz
        if t > tNear then tNear = t
        t = (b(node + fx) - ox) * ix * Bvh.FarSlack
        if t < tFar then tFar = t
        t = (b(node + fy) - oy) * iy * Bvh.FarSlack
        if t < tFar then tFar = t
        t = (b(node + fz) - oz) * iz * Bvh.FarSlack
        if t < tFar then tFar = t
        val hitsLeft = tNear <= tFar
        val tNearLeft = tNear
        tNear = 0f
        tFar = ray.tMax * Bvh.FarSlack
        t = (b(node + 6 + nx) - ox) * ix
        if t > tNear then tNear = t
        t = (b(node + 6 + ny) - oy) * iy
        if t > tNear then tNear = t
        t = (b(node + 6 + nz) - oz) * iz
        if t > tNear then tNear = t
        t = (b(node + 6 + fx) - ox) * ix * Bvh.FarSlack
        if t < tFar then tFar = t
        t = (b(node + 6 + fy) - oy) * iy * Bvh.FarSlack
        if t < tFar then tFar = t
        t = (b(node + 6 + fz) - oz) * iz * Bvh.FarSlack
        if t < tFar then tFar = t
        val hitsRight = tNear <= tFar
        if hitsLeft && hitsRight then
          val leftFirst = tNearLeft <= tNear
          val farSide = if leftFirst then 1 else 0
          stack(top) = ((if leftFirst then tNear else tNearLeft).toRawBits.toLong << 32) |
            (node + farSide)
          top += 1
          val nearSide = 1 - farSide
          leafSize = bits(node + 14 + nearSide)
          node = bits(node + 12 + nearSide)
        else if hitsLeft then
          leafSize = bits(node + 14)
          node = bits(node + 12)
        else if hitsRight then
          leafSize = bits(node + 15)
          node = bits(node + 13)
        else node = Bvh.Pop
      else if node != Bvh.Pop then
        val firstSlot = ~node
        inline if anyHit then
          if packed.isHit(firstSlot, firstSlot + leafSize, ray, hit) then
            hasHit = true
            going = false
        else if packed.intersect(firstSlot, firstSlot + leafSize, ray, hit) then hasHit = true
        node = Bvh.Pop
      if going && node == Bvh.Pop then
        // Pop the next subtree that begins before the closest hit
        going = false
        while !going && top > 0 do
          top -= 1
          val entry = stack(top)
          if java.lang.Float.intBitsToFloat((entry >>> 32).toInt) <= ray.tMax * Bvh.FarSlack then
            val slot = entry.toInt
            leafSize = bits(slot + 14)
            node = bits(slot + 12)
            going = true
    hasHit

  extension (x: Float)
    private inline def toRawBits: Int = java.lang.Float.floatToRawIntBits(x)

object Bvh:
  /** Exceeds 1 + 12 rounding errors: the rounding of slab distances, hits and the Float triangle
    * test must not lose a box that is hit at grazing incidence (Ize, "Robust BVH Ray Traversal",
    * JCGT 2(2), 2013).
    */
  private inline val FarSlack = 1.000001f

  /** A level has one child that waits. */
  private val StackSize = BvhBuilder.MaxDepth

  /** Node code for "pop the stack": no leaf can start at that slot. */
  private inline val Pop = Int.MinValue
