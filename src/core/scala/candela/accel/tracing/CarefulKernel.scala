package candela.accel.tracing

import candela.accel.WideTree
import candela.geometry.{Hit, Ray}

/** Traverses a [[WideTree]] in Double, for rays that are not range-safe: directions or origins so
  * large or small that Floats overflow. Slow, and rarely used.
  */
private[tracing] object CarefulKernel extends WideKernel:
  def closest(tree: WideTree, ray: Ray, hit: Hit): Boolean = traverse(tree, ray, hit, false)
  def isOccluded(tree: WideTree, ray: Ray, hit: Hit): Boolean = traverse(tree, ray, hit, true)
  def name: String = "careful"

  private inline def traverse(tree: WideTree, ray: Ray, hit: Hit, inline anyHit: Boolean): Boolean =
    isFinite(ray) && WideWalk.traverse(
      tree,
      tree.width,
      tree.lanes,
      ray,
      hit,
      anyHit,
      (node, limit) => boxes(tree, node, java.lang.Float.intBitsToFloat(limit), ray),
      _ => AnyLane,
      marksEdges = false,
      (_, _) => 0,
      (_, _) => false
    )

  private inline val AnyLane = 0xffff

  private def isFinite(ray: Ray): Boolean =
    java.lang.Float.isFinite(ray.ox) && java.lang.Float.isFinite(ray.oy) &&
      java.lang.Float.isFinite(ray.oz) && java.lang.Float.isFinite(ray.dx) &&
      java.lang.Float.isFinite(ray.dy) && java.lang.Float.isFinite(ray.dz)

  private def boxes(tree: WideTree, node: Int, limit: Float, ray: Ray): Int =
    val width = tree.width
    var hits = 0
    var k = 0
    while k < width do
      var tNear = 0.0
      var tFar = limit.toDouble
      var axis = 0
      while axis < 3 do
        val o = ray.along(axis).toDouble
        val d = if axis == 0 then ray.dx else if axis == 1 then ray.dy else ray.dz
        val low = tree.nodes(node + axis * width + k)
        val high = tree.nodes(node + (3 + axis) * width + k)
        if low == Float.PositiveInfinity then tFar = -1.0 // no child
        else if d == 0f then
          if !(low <= o && o <= high) then tFar = -1.0
        else
          val a = (low - o) / d
          val b = (high - o) / d
          tNear = Math.max(tNear, Math.min(a, b))
          tFar = Math.min(tFar, Math.max(a, b))
        axis += 1
      if tNear <= tFar * Slack then
        // Rounded down, as subtrees that begin later may be skipped
        ray.lanes(k) = java.lang.Float.floatToRawIntBits((tNear * (2.0 - Slack)).toFloat)
        hits |= 1 << k
      k += 1
    hits

  private final val Slack = 1.000001
