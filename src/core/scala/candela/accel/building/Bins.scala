package candela.accel.building

/** Bins of equal width over centroids along an axis, with the bounds of their primitives.
  *
  * Source: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", RT 2007.
  */
private[building] final class Bins:
  /** Bounds of each bin: see [[BoxRecord]]. */
  val boxes = new Array[Int](BoxRecord.Ints * Bins.Count)
  val counts = new Array[Int](Bins.Count)

  /** Clears the bins, fills them with records[first, end), and stores the bin of each record.
    *
    * @param low   lower bound of the first bin, in twice the coordinate
    * @param scale bins per unit of that
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
    clear()
    // In small batches, first the bins, then the boxes while they are still in cache
    val isLong = end - first >= Bins.LongRange
    var start = first
    while start < end do
      val stop = Math.min(end, start + Bins.Chunk)
      assign(records, binOf, start, stop, axis, low, scale)
      if isLong then growRarely(records, binOf, start, stop)
      else grow(records, binOf, start, stop)
      start = stop

  /** Fills the bins with every `step`th record. */
  def sample(
      records: Array[Int],
      first: Int,
      end: Int,
      step: Int,
      axis: Int,
      low: Float,
      scale: Float
  ): Unit =
    clear()
    var i = first
    while i < end do
      val offset = i * BoxRecord.Ints
      val bin = Bins.binIndex(BoxRecord.middle(records, offset, axis), low, scale)
      counts(bin) += 1
      BoxRecord.grow(boxes, bin * BoxRecord.Ints, records, offset)
      i += step

  private def assign(
      records: Array[Int],
      binOf: Array[Byte],
      first: Int,
      end: Int,
      axis: Int,
      low: Float,
      scale: Float
  ): Unit =
    var i = first
    var offset = first * BoxRecord.Ints
    while i < end do
      binOf(i) = Bins.binIndex(BoxRecord.middle(records, offset, axis), low, scale).toByte
      i += 1
      offset += BoxRecord.Ints

  private def grow(records: Array[Int], binOf: Array[Byte], first: Int, end: Int): Unit =
    val boxes = this.boxes
    val counts = this.counts
    var i = first
    var offset = first * BoxRecord.Ints
    while i < end do
      val bin = binOf(i)
      counts(bin) += 1
      BoxRecord.grow(boxes, bin * BoxRecord.Ints, records, offset)
      i += 1
      offset += BoxRecord.Ints

  private def growRarely(records: Array[Int], binOf: Array[Byte], first: Int, end: Int): Unit =
    val boxes = this.boxes
    val counts = this.counts
    var i = first
    var offset = first * BoxRecord.Ints
    while i < end do
      val bin = binOf(i)
      counts(bin) += 1
      BoxRecord.growRarely(boxes, bin * BoxRecord.Ints, records, offset)
      i += 1
      offset += BoxRecord.Ints

  def clear(): Unit =
    java.util.Arrays.fill(boxes, BoxRecord.MinusInfinity)
    java.util.Arrays.fill(counts, 0)

  /** Merges the contents of `other`. */
  def add(other: Bins): Unit =
    var bin = 0
    while bin < Bins.Count do
      counts(bin) += other.counts(bin)
      BoxRecord.grow(boxes, bin * BoxRecord.Ints, other.boxes, bin * BoxRecord.Ints)
      bin += 1

  /** First non-empty bin. */
  def firstUsed: Int =
    var bin = 0
    while bin < Bins.Count - 1 && counts(bin) == 0 do bin += 1
    bin

  def lastUsed: Int =
    var bin = Bins.Count - 1
    while bin > 0 && counts(bin) == 0 do bin -= 1
    bin

private[building] object Bins:
  inline val Count = 16

  private inline val Chunk = 64

  /** In ranges of at least this length, bins soon have their final bounds, and rarely grow. */
  private inline val LongRange = 2048

  /** Clamps to the valid bins, as rounding may place the outermost record just outside. */
  inline def binIndex(middle: Float, low: Float, scale: Float): Int =
    Math.max(0, Math.min(((middle - low) * scale).toInt, Count - 1))
