package candela.accel.building

/** Bounds and centroid range of the subtree under construction, for each depth on the path to it.
  *
  * The ranges are conservative. They follow for free from the bounds and the splits above;
  * measuring them would take another pass over the records.
  */
private[building] final class Levels:
  /** See [[BoxRecord]]. */
  val boxes = new Array[Int](BoxRecord.Ints * Levels.MaxDepth)

  /** Twice the coordinates: low x, y, z, high x, y, z. */
  private val ranges = new Array[Float](6 * Levels.MaxDepth)

  /** Returns new levels with a copy of this depth. */
  def copy(depth: Int): Levels =
    val result = Levels()
    BoxRecord.copy(boxes, depth * BoxRecord.Ints, result.boxes, depth * BoxRecord.Ints)
    System.arraycopy(ranges, 6 * depth, result.ranges, 6 * depth, 6)
    result

  def low(depth: Int, axis: Int): Float = ranges(6 * depth + axis)
  def extent(depth: Int, axis: Int): Float =
    ranges(6 * depth + 3 + axis) - ranges(6 * depth + axis)

  /** Resets the centroid range to unbounded. */
  def resetRange(depth: Int): Unit =
    java.util.Arrays.fill(ranges, 6 * depth, 6 * depth + 3, Float.NegativeInfinity)
    java.util.Arrays.fill(ranges, 6 * depth + 3, 6 * depth + 6, Float.PositiveInfinity)

  def clip(depth: Int, axis: Int, low: Float, high: Float): Unit =
    val offset = 6 * depth + axis
    if low > ranges(offset) then ranges(offset) = low
    if high < ranges(offset + 3) then ranges(offset + 3) = high

  /** Clips the centroid range to the bounds. */
  def tighten(depth: Int): Unit =
    val box = depth * BoxRecord.Ints
    var axis = 0
    while axis < 3 do
      val low = -BoxRecord.decode(boxes(box + axis))
      val high = BoxRecord.decode(boxes(box + BoxRecord.High + axis))
      clip(depth, axis, 2f * low, 2f * high)
      axis += 1

  /** Measures the centroid range. */
  def measure(depth: Int, records: Array[Int], first: Int, end: Int): Unit =
    var axis = 0
    while axis < 3 do
      var low = Float.PositiveInfinity
      var high = Float.NegativeInfinity
      var i = first
      while i < end do
        val middle = BoxRecord.middle(records, i * BoxRecord.Ints, axis)
        if middle < low then low = middle
        if middle > high then high = middle
        i += 1
      ranges(6 * depth + axis) = low
      ranges(6 * depth + 3 + axis) = high
      axis += 1

  /** Axis of largest centroid extent. */
  def widest(depth: Int): Int = largestAxis(extent(depth, 0), extent(depth, 1), extent(depth, 2))

  /** Longest axis of the bounds. */
  def longest(depth: Int): Int =
    val offset = depth * BoxRecord.Ints
    largestAxis(
      BoxRecord.side(boxes, offset, 0),
      BoxRecord.side(boxes, offset, 1),
      BoxRecord.side(boxes, offset, 2)
    )

  private def largestAxis(x: Float, y: Float, z: Float): Int =
    if x >= y then if x >= z then 0 else 2
    else if y >= z then 1
    else 2

  /** Splits the centroid range: the left child, at depth + 1, is below the plane; the right child,
    * which replaces the whole, is above it.
    */
  def splitRange(depth: Int, axis: Int, plane: Float): Unit =
    System.arraycopy(ranges, 6 * depth, ranges, 6 * depth + 6, 6)
    clip(depth + 1, axis, Float.NegativeInfinity, plane)
    clip(depth, axis, plane, Float.PositiveInfinity)

  /** Copies bounds and range of `depth` to the next depth. */
  def descend(depth: Int): Unit =
    val offset = depth * BoxRecord.Ints
    BoxRecord.copy(boxes, offset, boxes, offset + BoxRecord.Ints)
    System.arraycopy(ranges, 6 * depth, ranges, 6 * depth + 6, 6)

private[building] object Levels:
  /** Maximum SAH depth, plus the depth of median splits of 2³¹ boxes, plus one. */
  inline val MaxDepth = 128
