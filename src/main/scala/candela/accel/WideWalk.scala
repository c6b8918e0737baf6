package candela.accel

import candela.geometry.{Hit, Ray}
import candela.shapes.TriangleTest

/** The walk through a [[WideTree]], made into a kernel by its two questions. All of it is inlined:
  * each kernel has a loop of its own, without calls through interfaces.
  *
  * A walk goes to the nearest child first and keeps the others on a stack of Longs, each its
  * distance's bits over its code, sorted as it is put there. Distances are never negative, and
  * such Floats are ordered as their bits are: comparing Ints is cheaper than comparing Floats,
  * which have NaN and −0 to look after.
  */
private[accel] object WideWalk:

  /** @param width, lanes those of the tree, as constants if the kernel has any
    * @param boxes     (node, limit): bits of the children that begin before `limit`, the bits of a
    *                  distance; writes where they begin to `ray.lanes`, as bits too
    * @param triangles (block's first Float): bits of the lanes whose triangles may be hit; none
    *                  that [[TriangleTest]] accepts is missing
    */
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
    val nodes = tree.nodes
    val stack = ray.stack
    val begins = ray.lanes
    var limit = limitOf(ray.tMax)
    var found = false
    var top = 0
    var node = tree.root
    while node != WideTree.Nothing do
      if node >= 0 then
        var hits = boxes(node, limit)
        val children = node + 6 * width
        if hits == 0 then node = WideTree.Nothing
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
            inline if anyHit then
              if TriangleTest.isHit(tree.blocks, corners + k, lanes, ray, hit) then
                found = true
                may = 0
            else
              val owner =
                java.lang.Float.floatToRawIntBits(tree.blocks(corners + 9 * lanes + k))
              if TriangleTest.intersect(tree.blocks, corners + k, lanes, owner, ray, hit) then
                hit.primitive = owner
                found = true
        else
          val first = WideTree.first(node)
          inline if anyHit then
            found = tree.others.isHit(first, first + WideTree.size(node), ray, hit)
          else if tree.others.intersect(first, first + WideTree.size(node), ray, hit) then
            found = true
        limit = limitOf(ray.tMax)
        node = WideTree.Nothing
      if node == WideTree.Nothing then
        inline if anyHit then if found then top = 0
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

  private inline def entry(begin: Int, node: Int): Long =
    (begin.toLong << 32) | (node & 0xffffffffL)

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
