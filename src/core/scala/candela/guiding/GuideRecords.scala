package candela.guiding

import candela.base.{FloatBuffer, loop}
import candela.io.{CheckedInput, CheckedOutput}
import candela.sampling.SampleHash

/** The scattering events of one pass that found light. Each worker adds to a part of its own. Their
  * order depends on their own numbers, not on workers.
  *
  * @param rate    part of the guided paths that record
  * @param regions of the field that the paths use
  * @param memory  which passes share
  */
private[guiding] final class GuideRecords(
    val rate: Float,
    regions: Int,
    memory: GuideMemory = GuideMemory()
):
  import GuideRecords.*
  private var buffers = Vector.empty[Part]

  /** For a worker. */
  def newPart(): Part = synchronized:
    val buffer = Part(regions, memory.acquire())
    buffers :+= buffer
    buffer

  /** Of each region, its events: those without light, too. */
  def counts: Array[Long] = Array.tabulate(regions)(region => buffers.map(_.counts(region)).sum)

  /** Of each region, the rays that an event there brings about on average. */
  def costs: Array[Float] =
    Array.tabulate(regions): region =>
      val events = buffers.map(_.counts(region)).sum
      (buffers.map(_.costs(region)).sum.toDouble / Math.max(1L, events)).toFloat

  /** Rays of a path on average. */
  def pathCost: Double =
    buffers.map(_.allCosts).sum.toDouble / Math.max(1L, buffers.map(_.paths).sum)

  /** Gives the memory back; no path may be on its way. */
  def release(): Unit =
    for buffer <- buffers do
      memory.giveBack(buffer.data)
      buffer.data = FloatBuffer()
    buffers = Vector.empty

  /** All events, in an order that depends on their numbers only. They are overwritten by the next
    * that the memory is asked for.
    */
  def sorted(): GuideEvents =
    val count = buffers.map(_.count).sum
    val numbers = joined(count)
    // The upper bits of the hash, then the place
    val keys = memory.keys(count)
    loop(count)(i => keys(i) = (hash(numbers, i * Size) & ~PlaceMask) | i)
    java.util.Arrays.sort(keys, 0, count)
    loop(count): i =>
      var j = i
      while j > 0 && (keys(j - 1) | PlaceMask) == (keys(j) | PlaceMask) &&
        isLess(numbers, indexOf(keys(j)), indexOf(keys(j - 1)))
      do
        val key = keys(j)
        keys(j) = keys(j - 1)
        keys(j - 1) = key
        j -= 1
    putInOrder(numbers, keys, count)
    GuideEvents(numbers, count)

  private def indexOf(key: Long): Int = (key & PlaceMask).toInt

  /** Puts each event where its key is: along the cycles of the permutation. */
  private def putInOrder(numbers: Array[Float], keys: Array[Long], count: Int): Unit =
    val first = memory.event
    def copy(from: Int, to: Int): Unit =
      System.arraycopy(numbers, from * Size, numbers, to * Size, Size)
    loop(count): i =>
      if indexOf(keys(i)) != i then
        System.arraycopy(numbers, i * Size, first, 0, Size)
        var to = i
        var from = indexOf(keys(to))
        while from != i do
          copy(from, to)
          keys(to) = to
          to = from
          from = indexOf(keys(to))
        System.arraycopy(first, 0, numbers, to * Size, Size)
        keys(to) = to

  private def joined(count: Int): Array[Float] =
    val numbers = memory.numbers(Math.multiplyExact(Size, count))
    var offset = 0
    for buffer <- buffers do
      buffer.data.copyTo(numbers, offset)
      offset += buffer.data.length
    numbers

  /** Writes what is recorded; no path may be on its way. */
  def save(to: CheckedOutput): Unit =
    val events = sorted()
    to.int(events.count * Size)
    loop(events.count * Size)(i => to.float(events.numbers(i)))
    counts.foreach(to.long(_))
    loop(regions)(region => to.long(buffers.map(_.costs(region)).sum))
    to.long(buffers.map(_.paths).sum)
    to.long(buffers.map(_.allCosts).sum)

  def load(from: CheckedInput): Unit =
    val buffer = newPart()
    val count = from.count(bytes = 4)
    require(count % Size == 0, s"it has $count numbers of events")
    loop(count): i =>
      val number = from.float()
      require(i % Size != Side || (number >= 0 && number < GuideField.Sides), s"side $number")
      buffer.data += number
    loop(regions)(i => buffer.counts(i) = from.long())
    loop(regions)(i => buffer.costs(i) = from.long())
    buffer.paths = from.long()
    buffer.allCosts = from.long()

/** Recorded events, sorted.
  *
  * @param numbers [[GuideRecords.Size]] of each event; there may be more
  */
private[guiding] final class GuideEvents(val numbers: Array[Float], val count: Int):

  /** How many are the first ones of their paths? */
  def firsts: Int =
    import GuideRecords.*
    (0 until count).count(i => numbers(i * Size + Total) > 0f)

object GuideRecords:
  /** Numbers of an event, and their places: the point, the side of its normal, the direction taken,
    * the light that came from there, as the path received it, over its throughput before; the
    * densities of the direction: that of the path, of BSDF sampling, of the field. For the first
    * event of a path also all its light, the second moment that it would contribute if it had
    * sampled BSDFs only, and the light found before; else 0.
    */
  private[guiding] inline val Size = 14

  /** Of an event. */
  val Bytes: Long = 4L * Size

  private[guiding] inline val Side = 3
  private[guiding] inline val Wi = 4
  private[guiding] inline val Light = 7
  private[guiding] inline val Pdf = 8
  private[guiding] inline val BsdfPdf = 9
  private[guiding] inline val GuidePdf = 10
  private[guiding] inline val Total = 11
  private[guiding] inline val Unguided = 12
  private[guiding] inline val EarlierLight = 13

  // Of a key: the place of the event among all
  private inline val PlaceMask = 0xffffffL

  /** What one worker records. */
  final class Part private[guiding] (regions: Int, private[guiding] var data: FloatBuffer):
    private[guiding] val counts, costs = new Array[Long](regions)
    private[guiding] var paths, allCosts = 0L

    /** Counts an event. */
    def countEvent(region: Int): Unit = counts(region) += 1

    /** Counts the rays that an event brings about. */
    private[guiding] def countRays(region: Int, rays: Int): Unit = costs(region) += rays

    /** Counts a path and its rays. */
    private[guiding] def countPath(rays: Int): Unit =
      paths += 1
      allCosts += rays

    private[guiding] def count: Int = data.length / Size

    private[guiding] def add(event: Array[Float]): Unit =
      if count < PlaceMask then loop(Size)(i => data += event(i))

  private def hash(of: Array[Float], at: Int): Long =
    var h = 0L
    loop(Size): i =>
      h = SampleHash.mix64(h + SampleHash.Step + java.lang.Float.floatToRawIntBits(of(at + i)))
    h

  private def isLess(of: Array[Float], i: Int, j: Int): Boolean =
    var k = 0
    while k < Size - 1 && of(i * Size + k) == of(j * Size + k) do k += 1
    of(i * Size + k) < of(j * Size + k)
