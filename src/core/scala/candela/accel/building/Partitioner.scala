package candela.accel.building

/** Partitions records (see [[BoxRecord]]) by a split.
  *
  * Lists the misplaced records in batches, then swaps them: listing takes no data-dependent branch.
  * Source: Edelkamp and Weiß, "BlockQuicksort: Avoiding Branch Mispredictions in Quicksort", ESA
  * 2016.
  */
private[building] final class Partitioner(records: Array[Int]):
  import Partitioner.Block

  private val onLeft = new Array[Int](Block)
  private val onRight = new Array[Int](Block)

  /** Swaps the misplaced records on both sides of `middle`: the first with the first, and so on.
    * Both sides must have equally many.
    *
    * @param bins bin of each record; bins up to `cut` belong to the left
    */
  def run(bins: Array[Byte], cut: Int, first: Int, middle: Int, end: Int): Unit =
    val leftBatch = onLeft
    val rightBatch = onRight
    var i = first
    var j = middle
    var leftAt, leftEnd, rightAt, rightEnd = 0
    var going = true
    while going do
      if leftAt == leftEnd then
        leftAt = 0
        leftEnd = 0
        while leftEnd == 0 && i < middle do
          val stop = Math.min(middle, i + Block)
          while i < stop do
            leftBatch(leftEnd) = i
            leftEnd += (cut - bins(i)) >>> 31
            i += 1
      if rightAt == rightEnd then
        rightAt = 0
        rightEnd = 0
        while rightEnd == 0 && j < end do
          val stop = Math.min(end, j + Block)
          while j < stop do
            rightBatch(rightEnd) = j
            rightEnd += 1 - ((cut - bins(j)) >>> 31)
            j += 1
      val n = Math.min(leftEnd - leftAt, rightEnd - rightAt)
      var k = 0
      while k < n do
        Partitioner.exchange(records, leftBatch(leftAt + k), rightBatch(rightAt + k))
        k += 1
      leftAt += n
      rightAt += n
      going = n > 0

private[building] object Partitioner:
  private inline val Block = 128

  def exchange(records: Array[Int], i: Int, j: Int): Unit =
    val a = i * BoxRecord.Ints
    val b = j * BoxRecord.Ints
    val a0 = records(a)
    val a1 = records(a + 1)
    val a2 = records(a + 2)
    val a3 = records(a + 3)
    val a4 = records(a + 4)
    val a5 = records(a + 5)
    val a6 = records(a + 6)
    BoxRecord.copy(records, b, records, a)
    records(b) = a0
    records(b + 1) = a1
    records(b + 2) = a2
    records(b + 3) = a3
    records(b + 4) = a4
    records(b + 5) = a5
    records(b + 6) = a6
