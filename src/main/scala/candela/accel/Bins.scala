package candela.accel

/** Slabs of equal width across an axis, and the boxes whose centres are in them.
  *
  * Source: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", RT 2007.
  */
private[accel] final class Bins:
  /** The union of each slab's boxes: see [[BoxRecord]]. */
  val boxes = new Array[Int](BoxRecord.Ints * Bins.Count)
  val counts = new Array[Int](Bins.Count)

  /** Fills them anew with records[first, end), and notes in which each one is.
    *
    * @param low   where the first slab begins, in twice the coordinate
    * @param scale slabs per unit of that
    */
  def fill(
      records: Array[Int],
      binOf: Array[Byte],
      first: Int,
      end: Int,
      axis: Int,
      low: Float,
      scale: Float
  ): Unit =
    val boxes = this.boxes
    val counts = this.counts
    clear()
    var i = first
    var at = first * BoxRecord.Ints
    while i < end do
      val place = ((BoxRecord.middle(records, at, axis) - low) * scale).toInt
      // Rounding may place the outermost just outside
      val bin = Math.max(0, Math.min(place, Bins.Count - 1))
      binOf(i) = bin.toByte
      counts(bin) += 1
      BoxRecord.grow(boxes, bin * BoxRecord.Ints, records, at)
      i += 1
      at += BoxRecord.Ints

  def clear(): Unit =
    java.util.Arrays.fill(boxes, BoxRecord.Least)
    java.util.Arrays.fill(counts, 0)

  /** Adds what others hold. */
  def add(others: Bins): Unit =
    var bin = 0
    while bin < Bins.Count do
      counts(bin) += others.counts(bin)
      BoxRecord.grow(boxes, bin * BoxRecord.Ints, others.boxes, bin * BoxRecord.Ints)
      bin += 1

  /** The first that holds anything. */
  def firstUsed: Int =
    var bin = 0
    while bin < Bins.Count - 1 && counts(bin) == 0 do bin += 1
    bin

  def lastUsed: Int =
    var bin = Bins.Count - 1
    while bin > 0 && counts(bin) == 0 do bin -= 1
    bin

private[accel] object Bins:
  inline val Count = 16
