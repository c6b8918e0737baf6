package candela.accel.building

/** A way to divide a range of records (see [[BoxRecord]]), and the best division that it found
  * last. Has work space, and so belongs to one worker.
  */
private[building] abstract class Cut:

  /** Looks for the best division of records[first, end), whose box and whose centres' range are at
    * `depth`; false if there is none.
    */
  def find(first: Int, end: Int, levels: Levels, depth: Int): Boolean

  /** What it found: boxes of both parts, and how many are on the left. */
  protected def sweep: Sweep

  /** Sorts the records so that the left part comes first. */
  def divide(first: Int, end: Int): Unit

  /** What the division says about where the centres are: of the left part to depth + 1, of the
    * right part to depth, where it waits for its turn.
    */
  protected def narrow(levels: Levels, depth: Int): Unit

  final def cost: Float = sweep.cost
  final def left: Int = sweep.left

  /** Takes `levels` to the left part at depth + 1; the right part takes the place of the whole. */
  final def descend(levels: Levels, depth: Int): Unit =
    val here = depth * BoxRecord.Ints
    sweep.leftBox(levels.boxes, here + BoxRecord.Ints)
    sweep.rightBox(levels.boxes, here)
    narrow(levels, depth)

/** Divides few records, between any two neighbours in the order of centres along the longest
  * side.
  */
private[building] final class FewCut(records: Array[Int], shift: Int) extends Cut:
  import FewCut.Most

  private val keys = new Array[Long](Most)
  private val sorted = new Array[Int](BoxRecord.Ints * Most)
  protected val sweep: Sweep = Sweep(sorted, Array.fill(Most)(1))

  def find(first: Int, end: Int, levels: Levels, depth: Int): Boolean =
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
      val from = (first + keys(i).toInt) * BoxRecord.Ints
      BoxRecord.copy(records, from, sorted, i * BoxRecord.Ints)
      i += 1
    sweep.run(n, n, shift)
    // Of boxes without an area all cuts are as good; halves are as good and shallow
    sweep.cost > 0f && sweep.cost < Float.PositiveInfinity

  def divide(first: Int, end: Int): Unit =
    System.arraycopy(sorted, 0, records, first * BoxRecord.Ints, (end - first) * BoxRecord.Ints)

  /** Few records stay few, whose centres are looked at anyway. */
  protected def narrow(levels: Levels, depth: Int): Unit = ()

private[building] object FewCut:
  /** From here on up bins are as good, and faster. */
  inline val Most = 8
