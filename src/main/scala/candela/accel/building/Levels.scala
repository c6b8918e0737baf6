package candela.accel.building

/** What is known about the part of a tree that is being built, for each depth on the way to it: its
  * box, and between which planes its centres are.
  *
  * The planes are only bounds. They come for nothing from the boxes and from the cuts above, while
  * to measure them would be another pass over the records.
  */
private[building] final class Levels:
  /** See [[BoxRecord]]. */
  val boxes = new Array[Int](BoxRecord.Ints * Levels.Most)

  /** In twice the coordinates: low x, y, z, high x, y, z. */
  private val ranges = new Array[Float](6 * Levels.Most)

  /** Others that know what this one does of that depth. */
  def copy(depth: Int): Levels =
    val other = Levels()
    BoxRecord.copy(boxes, depth * BoxRecord.Ints, other.boxes, depth * BoxRecord.Ints)
    System.arraycopy(ranges, 6 * depth, other.ranges, 6 * depth, 6)
    other

  def low(depth: Int, axis: Int): Float = ranges(6 * depth + axis)
  def extent(depth: Int, axis: Int): Float =
    ranges(6 * depth + 3 + axis) - ranges(6 * depth + axis)

  /** Nothing is known about the centres yet. */
  def open(depth: Int): Unit =
    java.util.Arrays.fill(ranges, 6 * depth, 6 * depth + 3, Float.NegativeInfinity)
    java.util.Arrays.fill(ranges, 6 * depth + 3, 6 * depth + 6, Float.PositiveInfinity)

  def clip(depth: Int, axis: Int, low: Float, high: Float): Unit =
    val at = 6 * depth + axis
    if low > ranges(at) then ranges(at) = low
    if high < ranges(at + 3) then ranges(at + 3) = high

  /** Centres are within the box. */
  def tighten(depth: Int): Unit =
    val box = depth * BoxRecord.Ints
    var axis = 0
    while axis < 3 do
      val low = -BoxRecord.decode(boxes(box + axis))
      val high = BoxRecord.decode(boxes(box + BoxRecord.High + axis))
      clip(depth, axis, 2f * low, 2f * high)
      axis += 1

  /** Looks where the centres are. */
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

  /** The axis along which centres are spread widest. */
  def widest(depth: Int): Int = most(extent(depth, 0), extent(depth, 1), extent(depth, 2))

  /** The axis of the box's longest side. */
  def longest(depth: Int): Int =
    val at = depth * BoxRecord.Ints
    most(BoxRecord.side(boxes, at, 0), BoxRecord.side(boxes, at, 1), BoxRecord.side(boxes, at, 2))

  private def most(x: Float, y: Float, z: Float): Int =
    if x >= y then if x >= z then 0 else 2
    else if y >= z then 1
    else 2

  /** Centres of the left child, at depth + 1, are below the plane; those of the right, which takes
    * the place of the whole, are above it.
    */
  def part(depth: Int, axis: Int, plane: Float): Unit =
    System.arraycopy(ranges, 6 * depth, ranges, 6 * depth + 6, 6)
    clip(depth + 1, axis, Float.NegativeInfinity, plane)
    clip(depth, axis, plane, Float.PositiveInfinity)

  /** Takes box and range of `depth` to the next one. */
  def descend(depth: Int): Unit =
    val here = depth * BoxRecord.Ints
    BoxRecord.copy(boxes, here, boxes, here + BoxRecord.Ints)
    System.arraycopy(ranges, 6 * depth, ranges, 6 * depth + 6, 6)

private[building] object Levels:
  /** The depth of a tree by the surface area heuristic, that of halving 2³¹ boxes, and one more. */
  inline val Most = 128
