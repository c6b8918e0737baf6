package candela.lights

import candela.base.loop
import java.util.Arrays

/** The order of lights in a [[LightTree]], while it is built: numbers in flat arrays, as there may
  * be millions. Ranges without a common place can be split at the same time.
  */
private[lights] final class LightOrder(bounds: Array[LightBounds]):
  private val centers =
    Array.tabulate(3)(axis => bounds.map(_.box.center(axis)))
  private val order = Array.range(0, bounds.length)
  private val keys = new Array[Long](bounds.length)
  private val sorted = new Array[Int](bounds.length)

  /** Number of the light at a place. */
  def apply(place: Int): Int = order(place)

  /** Sorts lights along the axis of their largest extent, equal ones as they were; returns where
    * the second half begins.
    */
  def split(from: Int, until: Int): Int =
    val center = centers(widest(from, until))
    val count = until - from
    loop(count): i =>
      keys(from + i) = (LightOrder.sortable(center(order(from + i))).toLong << 32) | i
    Arrays.sort(keys, from, until)
    loop(count)(i => sorted(from + i) = order(from + keys(from + i).toInt))
    System.arraycopy(sorted, from, order, from, count)
    from + count / 2

  /** The first axis of the largest extent. */
  private def widest(from: Int, until: Int): Int =
    val x = extent(0, from, until)
    val y = extent(1, from, until)
    val z = extent(2, from, until)
    if !(y > x) && !(z > x) then 0 else if !(z > y) then 1 else 2

  private def extent(axis: Int, from: Int, until: Int): Float =
    val center = centers(axis)
    var low = Float.PositiveInfinity
    var high = Float.NegativeInfinity
    var i = from
    while i < until do
      low = Math.min(low, center(order(i)))
      high = Math.max(high, center(order(i)))
      i += 1
    high - low

private object LightOrder:
  /** Integers in the order of the numbers. */
  private def sortable(x: Float): Int =
    val bits = java.lang.Float.floatToIntBits(x)
    bits ^ ((bits >> 31) & Int.MaxValue)
