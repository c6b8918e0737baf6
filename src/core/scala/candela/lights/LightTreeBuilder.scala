package candela.lights

import candela.base.loop
import candela.concurrency.Parallel
import scala.collection.mutable

/** Builds a [[LightTree]]: bounds of its nodes, children, and the way to each light. */
private[lights] final class LightTreeBuilder(lights: Array[Light], pool: Parallel):
  private val allBounds = new Array[Option[LightBounds]](lights.length)
  pool.ranges(lights.length): (from, until) =>
    loop(until - from)(i => allBounds(from + i) = lights(from + i).bounds)
  private val finite: Array[Int] =
    lights.indices.filter(i => allBounds(i).exists(_.power > 0f)).toArray
  private val finiteBounds: Array[LightBounds] = finite.flatMap(allBounds(_))

  /** Bounds by node; children(i) is the second child (the first is i + 1), or ~light for a leaf.
    */
  val bounds = new Array[LightBounds](2 * finite.length)
  val children = new Array[Int](bounds.length)

  /** Path from the root to each light as bits, low bit first, 1 = second child; −1 if the light is
    * not in the tree.
    */
  val trail = Array.fill(lights.length)(-1L)

  if finite.nonEmpty then
    // Of these sizes parts are built at the same time
    val size =
      if pool.threads == 1 then finite.length else LightTreeBuilder.partSize(finite.length, pool)
    val tasks = mutable.ArrayBuffer.empty[() => Unit]
    divide(LightOrder(finiteBounds), 0, finite.length, 0, 0L, 0, size, tasks)
    pool.forEach(tasks.size)(i => tasks(i)())
    unite(0, finite.length, 0, size): Unit

  /** The second child of a node whose first has so many lights: a tree of n has 2n − 1 nodes. */
  private def secondChild(node: Int, ofFirst: Int): Int = node + 2 * ofFirst

  /** Splits nodes of more than `size` lights; the others are parts to build. */
  private def divide(
      order: LightOrder,
      from: Int,
      until: Int,
      node: Int,
      bits: Long,
      depth: Int,
      size: Int,
      tasks: mutable.ArrayBuffer[() => Unit]
  ): Unit =
    if until - from <= size then
      tasks += (() => build(order, from, until, node, bits, depth): Unit)
    else
      val middle = order.split(from, until)
      val second = secondChild(node, middle - from)
      children(node) = second
      divide(order, from, middle, node + 1, bits, depth + 1, size, tasks)
      divide(order, middle, until, second, bits | (1L << depth), depth + 1, size, tasks)

  /** The bounds of the nodes that were divided. */
  private def unite(from: Int, until: Int, node: Int, size: Int): LightBounds =
    if until - from > size then
      val middle = from + (until - from) / 2
      val first = unite(from, middle, node + 1, size)
      bounds(node) =
        first.union(unite(middle, until, secondChild(node, middle - from), size))
    bounds(node)

  /** Median splits: the depth stays at log2 of the count. */
  private def build(
      order: LightOrder,
      from: Int,
      until: Int,
      node: Int,
      bits: Long,
      depth: Int
  ): LightBounds =
    val nodeBounds =
      if until - from == 1 then
        val light = finite(order(from))
        children(node) = ~light
        trail(light) = bits
        finiteBounds(order(from))
      else
        val middle = order.split(from, until)
        val second = secondChild(node, middle - from)
        children(node) = second
        val a = build(order, from, middle, node + 1, bits, depth + 1)
        a.union(build(order, middle, until, second, bits | (1L << depth), depth + 1))
    bounds(node) = nodeBounds
    nodeBounds

private object LightTreeBuilder:
  /** Some for each thread, as they take different times; of thousands of lights. */
  private def partSize(lights: Int, pool: Parallel): Int =
    Math.max(4096, lights / (8 * pool.threads))
