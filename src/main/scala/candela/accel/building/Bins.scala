package candela.accel.building

/** Slabs of equal width across an axis, and the boxes whose centres are in them.
  *
  * Source: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", RT 2007.
  */
private[building] final class Bins:
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
    clear()
    // A few at a time: first where they are, then their boxes, while they are still at hand
    val isLong = end - first >= Bins.Long
    var from = first
    while from < end do
      val until = Math.min(end, from + Bins.Chunk)
      place(records, binOf, from, until, axis, low, scale)
      if isLong then growRarely(records, binOf, from, until)
      else grow(records, binOf, from, until)
      from = until

  /** Fills them with every `step`th record. */
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
      val at = i * BoxRecord.Ints
      val bin = Bins.place(BoxRecord.middle(records, at, axis), low, scale)
      counts(bin) += 1
      BoxRecord.grow(boxes, bin * BoxRecord.Ints, records, at)
      i += step

  private def place(
      records: Array[Int],
      binOf: Array[Byte],
      first: Int,
      end: Int,
      axis: Int,
      low: Float,
      scale: Float
  ): Unit =
    var i = first
    var at = first * BoxRecord.Ints
    while i < end do
      binOf(i) = Bins.place(BoxRecord.middle(records, at, axis), low, scale).toByte
      i += 1
      at += BoxRecord.Ints

  private def grow(records: Array[Int], binOf: Array[Byte], first: Int, end: Int): Unit =
    val boxes = this.boxes
    val counts = this.counts
    var i = first
    var at = first * BoxRecord.Ints
    while i < end do
      val bin = binOf(i)
      counts(bin) += 1
      BoxRecord.grow(boxes, bin * BoxRecord.Ints, records, at)
      i += 1
      at += BoxRecord.Ints

  private def growRarely(records: Array[Int], binOf: Array[Byte], first: Int, end: Int): Unit =
    val boxes = this.boxes
    val counts = this.counts
    var i = first
    var at = first * BoxRecord.Ints
    while i < end do
      val bin = binOf(i)
      counts(bin) += 1
      BoxRecord.growRarely(boxes, bin * BoxRecord.Ints, records, at)
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

private[building] object Bins:
  inline val Count = 16

  private inline val Chunk = 64

  /** So many records fill the bins' boxes soon, which then hardly grow. */
  private inline val Long = 2048

  /** Rounding may place the outermost just outside. */
  inline def place(middle: Float, low: Float, scale: Float): Int =
    Math.max(0, Math.min(((middle - low) * scale).toInt, Count - 1))
