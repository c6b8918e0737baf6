package candela.accel.tracing

import candela.accel.WideTree
import candela.geometry.{Hit, Ray}
import candela.shapes.TriangleTest

/** Traversals of a [[WideTree]], made into kernels by their two box and triangle tests. All of it
  * is inlined: each kernel has loops of its own, without interface calls.
  *
  * Closest-hit traversal is front-to-back: it visits the nearest child first and pushes the others
  * on a stack of Longs, each its distance's bits above its code, sorted as it is pushed. Distances
  * are never negative, so their bits have the order of the Floats: comparing Ints is cheaper than
  * comparing Floats, with their NaN and −0.
  *
  * Any-hit traversal is unordered: front-to-back order visits as many nodes. An entry of its stack
  * is a node below the bits of its children that are still to be visited.
  */
private[tracing] object WideWalk:

  /** Any-hit or closest-hit traversal: see [[occluded]] and [[closest]]. */
  inline def traverse(
      tree: WideTree,
      inline width: Int,
      inline lanes: Int,
      ray: Ray,
      hit: Hit,
      inline anyHit: Boolean,
      inline boxes: (Int, Int) => Int,
      inline triangles: Int => Int,
      inline marksEdges: Boolean,
      inline inRange: (Int, Float) => Int,
      inline inside: (Int, Int) => Boolean
  ): Boolean =
    inline if anyHit then
      occluded(tree, width, lanes, ray, hit, boxes, triangles, marksEdges, inRange, inside)
    else closest(tree, width, lanes, ray, hit, boxes, triangles, marksEdges, inRange, inside)

  /** @param width, lanes those of the tree, as constants if the kernel has any
    * @param boxes     (node, limit): bit mask of the children that begin before `limit`, the bits
    *   of a distance; writes their entry distances to `ray.lanes`, also as bits
    * @param triangles (block's first Float): bit mask of the lanes whose triangles may be hit;
    *   includes every triangle that [[TriangleTest]] accepts
    * @param marksEdges whether they have their bits from [[FirstEdgeBit]] on if the ray's line may
    *   pass at an edge, rather than inside
    * @param inRange   (block's first Float, end of the ray): the same bits, of the lanes whose
    *   triangles are near enough; used if `triangles` marks edges
    * @param inside    (triangle's first Float, its number): decides about one that the line passes
    *   inside; the same
    */
  private inline def closest(
      tree: WideTree,
      inline width: Int,
      inline lanes: Int,
      ray: Ray,
      hit: Hit,
      inline boxes: (Int, Int) => Int,
      inline triangles: Int => Int,
      inline marksEdges: Boolean,
      inline inRange: (Int, Float) => Int,
      inline inside: (Int, Int) => Boolean
  ): Boolean =
    val nodes = tree.nodes
    val stack = ray.stack(tree.stackSize)
    val begins = ray.lanes
    var limit = limitOf(ray.tMax)
    var hasHit = false
    var top = 0
    var node = tree.root
    while node != WideTree.NoChild do
      if node >= 0 then
        var hits = boxes(node, limit)
        val children = node + 6 * width
        if hits == 0 then node = WideTree.NoChild
        else
          val a = Integer.numberOfTrailingZeros(hits)
          hits &= hits - 1
          val firstChild = java.lang.Float.floatToRawIntBits(nodes(children + a))
          if hits == 0 then node = firstChild
          else
            val b = Integer.numberOfTrailingZeros(hits)
            hits &= hits - 1
            val secondChild = java.lang.Float.floatToRawIntBits(nodes(children + b))
            val isFirst = begins(a) <= begins(b)
            if hits == 0 then
              stack(top) =
                if isFirst then entry(begins(b), secondChild) else entry(begins(a), firstChild)
              top += 1
              node = if isFirst then firstChild else secondChild
            else
              val bottom = top
              stack(top) =
                if isFirst then entry(begins(b), secondChild) else entry(begins(a), firstChild)
              stack(top + 1) =
                if isFirst then entry(begins(a), firstChild) else entry(begins(b), secondChild)
              top += 2
              while hits != 0 do
                val k = Integer.numberOfTrailingZeros(hits)
                hits &= hits - 1
                val pushed =
                  entry(begins(k), java.lang.Float.floatToRawIntBits(nodes(children + k)))
                var i = top
                while i > bottom && stack(i - 1) < pushed do
                  stack(i) = stack(i - 1)
                  i -= 1
                stack(i) = pushed
                top += 1
              top -= 1
              node = stack(top).toInt
      else
        if WideTree.isBlock(node) then
          val block = WideTree.leafStart(node)
          val corners = block * WideTree.blockFloats(lanes)
          var candidateBits = candidates(node, corners, ray, triangles, marksEdges, inRange)
          while candidateBits != 0 do
            val bit = Integer.numberOfTrailingZeros(candidateBits)
            candidateBits &= candidateBits - 1
            val k = bit & (FirstEdgeBit - 1)
            val owner = java.lang.Float.floatToRawIntBits(tree.blocks(corners + 9 * lanes + k))
            val isHit =
              if tree.isMasked then
                tree.masked.intersect(
                  tree.blocks,
                  corners + k,
                  lanes,
                  owner,
                  ray,
                  hit,
                  shadow = false
                )
              else if marksEdges && bit < FirstEdgeBit then inside(corners + k, owner)
              else TriangleTest.intersect(tree.blocks, corners + k, lanes, owner, ray, hit)
            if isHit then
              hit.primitive = owner
              hasHit = true
        else
          val leafStart = WideTree.leafStart(node)
          if tree.unblocked.intersect(leafStart, leafStart + WideTree.size(node), ray, hit) then
            hasHit = true
        limit = limitOf(ray.tMax)
        node = WideTree.NoChild
      if node == WideTree.NoChild then
        // Pop the next subtree that begins before the closest hit
        var going = top > 0
        while going do
          top -= 1
          val popped = stack(top)
          if (popped >>> 32).toInt <= limit then
            node = popped.toInt
            going = false
          else going = top > 0
    hasHit

  /** Any-hit counterpart of [[closest]]; `boxes` writes nothing. */
  private inline def occluded(
      tree: WideTree,
      inline width: Int,
      inline lanes: Int,
      ray: Ray,
      hit: Hit,
      inline boxes: (Int, Int) => Int,
      inline triangles: Int => Int,
      inline marksEdges: Boolean,
      inline inRange: (Int, Float) => Int,
      inline inside: (Int, Int) => Boolean
  ): Boolean =
    val nodes = tree.nodes
    val stack = ray.stack(tree.stackSize)
    val limit = limitOf(ray.tMax)
    var hasHit = false
    var top = 0
    var node = tree.root
    while node != WideTree.NoChild do
      var current = node
      var hits = 0
      if node >= 0 then hits = boxes(node, limit)
      else if WideTree.isBlock(node) then
        val corners = WideTree.leafStart(node) * WideTree.blockFloats(lanes)
        var candidateBits = candidates(node, corners, ray, triangles, marksEdges, inRange)
        while candidateBits != 0 do
          val bit = Integer.numberOfTrailingZeros(candidateBits)
          candidateBits &= candidateBits - 1
          val k = bit & (FirstEdgeBit - 1)
          hasHit =
            if tree.isMasked then
              val owner = java.lang.Float.floatToRawIntBits(tree.blocks(corners + 9 * lanes + k))
              tree.masked.intersect(tree.blocks, corners + k, lanes, owner, ray, hit, shadow = true)
            else if marksEdges && bit < FirstEdgeBit then inside(corners + k, 0)
            else TriangleTest.isHit(tree.blocks, corners + k, lanes, ray, hit)
          if hasHit then candidateBits = 0
      else
        val leafStart = WideTree.leafStart(node)
        hasHit = tree.unblocked.isHit(leafStart, leafStart + WideTree.size(node), ray, hit)
      if hits == 0 && top > 0 then
        top -= 1
        val popped = stack(top)
        hits = (popped >>> 32).toInt
        current = popped.toInt
      if hasHit || hits == 0 then node = WideTree.NoChild
      else
        // The rest of the node's children stay on the stack; if none is left, the entry is
        // overwritten
        val remainingHits = hits & (hits - 1)
        stack(top) = entry(remainingHits, current)
        top += -remainingHits >>> 31
        val k = Integer.numberOfTrailingZeros(hits)
        node = java.lang.Float.floatToRawIntBits(nodes(current + 6 * width + k))
    hasHit

  /** The bits of the triangles of a block that are worth a test. */
  private inline def candidates(
      leaf: Int,
      corners: Int,
      ray: Ray,
      inline triangles: Int => Int,
      inline marksEdges: Boolean,
      inline inRange: (Int, Float) => Int
  ): Int =
    val occupied = (1 << WideTree.size(leaf)) - 1
    inline if marksEdges then
      val candidateBits = triangles(corners) & (occupied | (occupied << FirstEdgeBit))
      if candidateBits == 0 then 0 else candidateBits & inRange(corners, ray.tMax)
    else triangles(corners) & occupied

  private inline def entry(high: Int, node: Int): Long =
    (high.toLong << 32) | (node & 0xffffffffL)

  /** Error bound of a box's distances, in Floats (ulps): the rounding of its three operations, of
    * the Float triangle test and of the hit's distance, 12 half units in the last place in all.
    */
  final val Slack = 16

  /** Subtrees that begin beyond this limit lie past the end of the ray. Finite: what begins at
    * infinity is never hit.
    */
  inline def limitOf(tMax: Float): Int =
    Math.min(java.lang.Float.floatToRawIntBits(tMax) + Slack, Largest)

  private final val Largest = 0x7f7fffff

  /** The first bit of triangles that the ray's line may pass at an edge. */
  final val FirstEdgeBit = 16

  /** Tolerance of hits outside a triangle's box, relative to its extent, with some rounding. */
  final val Pad = 2.5e-6f

  /** Exceeds one by the rounding of distances. */
  final val Beyond = 1.000001f

  /** The bits of infinity; larger ones are NaN. */
  final val Infinity = 0x7f800000
