package candela.geometry

import candela.base.loop
import candela.math.clamp

/** A hierarchy of many boxes, for those that overlap another: halves of their order along a Morton
  * curve.
  */
final class BoxTree(count: Int, box: Int => Bounds3):
  private val leaves = Math.max(1, 2 * Integer.highestOneBit(Math.max(count - 1, 0)))
  private val bounds = new Array[Float](6 * 2 * leaves)
  private val order: Array[Int] = sorted()

  private def sorted(): Array[Int] =
    var all = Bounds3.Empty
    loop(count)(i => all = all.union(box(i)))
    val keys = new Array[Long](count)
    loop(count)(i => keys(i) = BoxTree.code(box(i), all) << 32 | i)
    java.util.Arrays.sort(keys)
    keys.map(_.toInt)

  loop(leaves): i =>
    val leaf = if i < count then box(order(i)) else Bounds3.Empty
    leaf.write(bounds, 6 * (leaves + i))
  for node <- leaves - 1 to 1 by -1 do at(2 * node).union(at(2 * node + 1)).write(bounds, 6 * node)

  private def at(node: Int): Bounds3 = Bounds3.read(bounds, 6 * node)

  /** Whether this holds for one that overlaps or touches the box; asks until it does. */
  def exists(b: Bounds3)(holds: Int => Boolean): Boolean =
    def below(node: Int): Boolean =
      at(node).overlaps(b) &&
        (if node >= leaves then holds(order(node - leaves))
         else below(2 * node) || below(2 * node + 1))
    below(1)

  def forEach(b: Bounds3)(f: Int => Unit): Unit =
    val _ = exists(b): i =>
      f(i)
      false

object BoxTree:
  private val Bits = 10

  /** Of the middle of a box within all: bits of its coordinates, in turn. */
  private def code(box: Bounds3, all: Bounds3): Long =
    val (p, extent) = (box.center - all.min, all.extent)
    var sum = 0L
    loop(3): axis =>
      val part = if extent(axis) > 0f then p(axis) / extent(axis) else 0f
      val cell = clamp((part * (1 << Bits)).toInt, 0, (1 << Bits) - 1)
      loop(Bits)(bit => sum |= (cell >> bit & 1L) << (3 * bit + axis))
    sum
