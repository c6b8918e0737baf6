package candela.accel.building

/** Split strategy for a range of records (see [[BoxRecord]]), with the best split last found. Owns
  * scratch memory: one per worker.
  */
private[building] abstract class Cut:

  /** Finds the best split of records[first, end), whose bounds and centroid range are at `depth`;
    * false if there is none.
    */
  def findSplit(first: Int, end: Int, levels: Levels, depth: Int): Boolean

  /** The split found: bounds of both parts, and the number of records on the left. */
  protected def sweep: Sweep

  /** Partitions the records, left part first. */
  def divide(first: Int, end: Int): Unit

  /** Narrows the centroid ranges by the split: the left part's at depth + 1, the right part's at
    * depth, where it awaits its turn.
    */
  protected def narrow(levels: Levels, depth: Int): Unit

  final def cost: Float = sweep.cost
  final def leftCount: Int = sweep.leftWeight

  /** Moves `levels` to the left part at depth + 1; the right part replaces the whole. */
  final def descend(levels: Levels, depth: Int): Unit =
    val offset = depth * BoxRecord.Ints
    sweep.leftBox(levels.boxes, offset + BoxRecord.Ints)
    sweep.rightBox(levels.boxes, offset)
    narrow(levels, depth)

/** Exact SAH split for small ranges, with a candidate between any two neighbouring centroids along
  * the longest axis.
  */
private[building] final class FewCut(records: Array[Int], shift: Int) extends Cut:
  import FewCut.MaxRange

  private val keys = new Array[Long](MaxRange)
  private val sorted = new Array[Int](BoxRecord.Ints * MaxRange)
  protected val sweep: Sweep = Sweep(sorted, Array.fill(MaxRange)(1))

  def findSplit(first: Int, end: Int, levels: Levels, depth: Int): Boolean =
    val n = end - first
    val axis = levels.longest(depth)
    val keys = this.keys
    var i = 0
    while i < n do
      val middle = BoxRecord.middle(records, (first + i) * BoxRecord.Ints, axis)
      val key = BoxRecord.encode(middle).toLong << 32 | i
      var j = i - 1
      while j >= 0 && keys(j) > key do
        keys(j + 1) = keys(j)
        j -= 1
      keys(j + 1) = key
      i += 1
    i = 0
    while i < n do
      val offset = (first + keys(i).toInt) * BoxRecord.Ints
      BoxRecord.copy(records, offset, sorted, i * BoxRecord.Ints)
      i += 1
    sweep.run(n, n, shift)
    // For boxes without area all splits cost the same; median splits keep the tree shallow
    sweep.cost > 0f && sweep.cost < Float.PositiveInfinity

  def divide(first: Int, end: Int): Unit =
    System.arraycopy(sorted, 0, records, first * BoxRecord.Ints, (end - first) * BoxRecord.Ints)

  /** Small ranges stay small, and their centroids are examined anyway. */
  protected def narrow(levels: Levels, depth: Int): Unit = ()

private[building] object FewCut:
  /** Range length above which bins are as good, and faster. */
  inline val MaxRange = 8
