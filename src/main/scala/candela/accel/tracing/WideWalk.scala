package candela.accel.tracing

import candela.accel.WideTree
import candela.geometry.{Hit, Ray}
import candela.shapes.TriangleTest

/** The walks through a [[WideTree]], made into kernels by their two questions. All of it is
  * inlined: each kernel has loops of its own, without calls through interfaces.
  *
  * The walk to the closest hit goes to the nearest child first and keeps the others on a stack of
  * Longs, each its distance's bits over its code, sorted as it is put there. Distances are never
  * negative, and such Floats are ordered as their bits are: comparing Ints is cheaper than
  * comparing Floats, which have NaN and −0 to look after.
  *
  * The walk to any hit has no order: in that of the distances it would see as many nodes. An entry
  * of its stack is a node under the bits of those of its children that are still to be visited.
  */
private[tracing] object WideWalk:

  /** The walk to any hit or to the closest one: see [[occluded]] and [[closest]]. */
  inline def walk(
      tree: WideTree,
      inline width: Int,
      inline lanes: Int,
      ray: Ray,
      hit: Hit,
      inline anyHit: Boolean,
      inline boxes: (Int, Int) => Int,
      inline triangles: Int => Int
  ): Boolean =
    inline if anyHit then occluded(tree, width, lanes, ray, hit, boxes, triangles)
    else closest(tree, width, lanes, ray, hit, boxes, triangles)

  /** @param width, lanes those of the tree, as constants if the kernel has any
    * @param boxes     (node, limit): bits of the children that begin before `limit`, the bits of a
    *                  distance; writes where they begin to `ray.lanes`, as bits too
    * @param triangles (block's first Float): bits of the lanes whose triangles may be hit; none
    *                  that [[TriangleTest]] accepts is missing
    */
  private inline def closest(
      tree: WideTree,
      inline width: Int,
      inline lanes: Int,
      ray: Ray,
      hit: Hit,
      inline boxes: (Int, Int) => Int,
      inline triangles: Int => Int
  ): Boolean =
    val nodes = tree.nodes
    val stack = ray.stack
    val begins = ray.lanes
    var limit = limitOf(ray.tMax)
    var found = false
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
          val first = java.lang.Float.floatToRawIntBits(nodes(children + a))
          if hits == 0 then node = first
          else
            val b = Integer.numberOfTrailingZeros(hits)
            hits &= hits - 1
            val second = java.lang.Float.floatToRawIntBits(nodes(children + b))
            val isFirst = begins(a) <= begins(b)
            if hits == 0 then
              stack(top) = if isFirst then entry(begins(b), second) else entry(begins(a), first)
              top += 1
              node = if isFirst then first else second
            else
              val bottom = top
              stack(top) = if isFirst then entry(begins(b), second) else entry(begins(a), first)
              stack(top + 1) = if isFirst then entry(begins(a), first) else entry(begins(b), second)
              top += 2
              while hits != 0 do
                val k = Integer.numberOfTrailingZeros(hits)
                hits &= hits - 1
                val next =
                  entry(begins(k), java.lang.Float.floatToRawIntBits(nodes(children + k)))
                var i = top
                while i > bottom && stack(i - 1) < next do
                  stack(i) = stack(i - 1)
                  i -= 1
                stack(i) = next
                top += 1
              top -= 1
              node = stack(top).toInt
      else
        if WideTree.isBlock(node) then
          val block = WideTree.first(node)
          val corners = block * WideTree.blockFloats(lanes)
          var may = triangles(corners) & ((1 << WideTree.size(node)) - 1)
          while may != 0 do
            val k = Integer.numberOfTrailingZeros(may)
            may &= may - 1
            val owner = java.lang.Float.floatToRawIntBits(tree.blocks(corners + 9 * lanes + k))
            if TriangleTest.intersect(tree.blocks, corners + k, lanes, owner, ray, hit) then
              hit.primitive = owner
              found = true
        else
          val first = WideTree.first(node)
          if tree.others.intersect(first, first + WideTree.size(node), ray, hit) then
            found = true
        limit = limitOf(ray.tMax)
        node = WideTree.NoChild
      if node == WideTree.NoChild then
        // The next subtree that begins before the closest hit
        var going = top > 0
        while going do
          top -= 1
          val next = stack(top)
          if (next >>> 32).toInt <= limit then
            node = next.toInt
            going = false
          else going = top > 0
    found

  /** As [[closest]], but `boxes` writes nothing. */
  private inline def occluded(
      tree: WideTree,
      inline width: Int,
      inline lanes: Int,
      ray: Ray,
      hit: Hit,
      inline boxes: (Int, Int) => Int,
      inline triangles: Int => Int
  ): Boolean =
    val nodes = tree.nodes
    val stack = ray.stack
    val limit = limitOf(ray.tMax)
    var found = false
    var top = 0
    var node = tree.root
    while node != WideTree.NoChild do
      var from = node
      var hits = 0
      if node >= 0 then hits = boxes(node, limit)
      else if WideTree.isBlock(node) then
        val corners = WideTree.first(node) * WideTree.blockFloats(lanes)
        var may = triangles(corners) & ((1 << WideTree.size(node)) - 1)
        while may != 0 do
          val k = Integer.numberOfTrailingZeros(may)
          may &= may - 1
          if TriangleTest.isHit(tree.blocks, corners + k, lanes, ray, hit) then
            found = true
            may = 0
      else
        val first = WideTree.first(node)
        found = tree.others.isHit(first, first + WideTree.size(node), ray, hit)
      if hits == 0 && top > 0 then
        top -= 1
        val next = stack(top)
        hits = (next >>> 32).toInt
        from = next.toInt
      if found || hits == 0 then node = WideTree.NoChild
      else
        // What is left of the node stays on the stack, or is overwritten if it is nothing
        val rest = hits & (hits - 1)
        stack(top) = entry(rest, from)
        top += -rest >>> 31
        val k = Integer.numberOfTrailingZeros(hits)
        node = java.lang.Float.floatToRawIntBits(nodes(from + 6 * width + k))
    found

  private inline def entry(high: Int, node: Int): Long =
    (high.toLong << 32) | (node & 0xffffffffL)

  /** By how many Floats a box's distances may be off: its three operations' rounding, that of the
    * Float triangle test and of the hit's distance, 12 half units in the last place in all.
    */
  final val Slack = 16

  /** What begins later than this is behind the end of the ray. Finite: what begins at infinity is
    * never met.
    */
  inline def limitOf(tMax: Float): Int =
    Math.min(java.lang.Float.floatToRawIntBits(tMax) + Slack, Largest)

  private final val Largest = 0x7f7fffff

  /** The bits of infinity: what is above is no number. */
  final val Infinity = 0x7f800000
