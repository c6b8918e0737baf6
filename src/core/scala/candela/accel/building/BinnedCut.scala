package candela.accel.building

import candela.concurrency.Parallel

/** Binned SAH split with 16 bins, for large ranges of primitives.
  *
  * Splits along the axis of largest centroid extent. Only if that split is poor, tries the two
  * other axes as well: this is rare in meshes, so costs little, yet improves the trees
  * (docs/decisions/0012).
  *
  * @param shift see [[Sweep]]
  * @param binOf bin of each record, by axis, as last filled
  */
private[building] class BinnedCut(records: Array[Int], shift: Int, binOf: Array[Array[Byte]])
    extends Cut:
  private var bestSplit = Slabs()
  private var trial = Slabs()
  private var axis = 0

  protected def sweep: Sweep = bestSplit.sweep

  def findSplit(first: Int, end: Int, levels: Levels, depth: Int): Boolean =
    levels.tighten(depth)
    attemptWidest(first, end, levels, depth)
    if bestSplit.sweep.cost == Float.PositiveInfinity then
      // If the centroid range was overestimated, all centroids may fall into one bin
      levels.measure(depth, records, first, end)
      attemptWidest(first, end, levels, depth)
    val area = BoxRecord.halfArea(levels.boxes, depth * BoxRecord.Ints)
    if bestSplit.sweep.cost > BinnedCut.Poor * Sweep.blocks(end - first, shift) * area then
      val widest = axis
      val step = (end - first) / BinnedCut.Sample
      val minCost = if step > 1 then sampled(first, end, widest, step, levels, depth) else 0f
      var k = 0
      while k < 3 do
        if k != widest && (step <= 1 || sampled(first, end, k, step, levels, depth) < minCost) then
          attempt(first, end, k, levels, depth)
          if trial.sweep.cost < bestSplit.sweep.cost then
            swap()
            axis = k
        k += 1
    bestSplit.sweep.cost < Float.PositiveInfinity

  private def attemptWidest(first: Int, end: Int, levels: Levels, depth: Int): Unit =
    axis = levels.widest(depth)
    attempt(first, end, axis, levels, depth)
    swap()

  private def swap(): Unit =
    val previous = bestSplit
    bestSplit = trial
    trial = previous

  private def attempt(first: Int, end: Int, axis: Int, levels: Levels, depth: Int): Unit =
    val low = levels.low(depth, axis)
    val scale = Bins.Count / levels.extent(depth, axis)
    trial.low = low
    trial.scale = scale
    trial.sweep.cost = Float.PositiveInfinity
    // A centroid range that is empty, infinite, or so small that its inverse overflows has no bins
    if scale > 0f && scale < Float.PositiveInfinity then
      val bins = trial.bins
      fill(bins, first, end, axis, low, scale)
      trial.sweep.run(Bins.Count, end - first, shift)
      levels.clip(depth, axis, low + bins.firstUsed / scale, low + (bins.lastUsed + 1) / scale)

  /** SAH cost of a split along the axis, estimated from every `step`th record. */
  private def sampled(
      first: Int,
      end: Int,
      axis: Int,
      step: Int,
      levels: Levels,
      depth: Int
  ): Float =
    val low = levels.low(depth, axis)
    val scale = Bins.Count / levels.extent(depth, axis)
    if scale > 0f && scale < Float.PositiveInfinity then
      trial.bins.sample(records, first, end, step, axis, low, scale)
      trial.sweep.run(Bins.Count, (end - first + step - 1) / step, shift)
      trial.sweep.cost
    else Float.PositiveInfinity

  /** Fills the bins. */
  protected def fill(bins: Bins, first: Int, end: Int, axis: Int, low: Float, scale: Float): Unit =
    bins.fill(records, binOf(axis), first, end, axis, low, scale)

  def divide(first: Int, end: Int): Unit =
    partition(binOf(axis), bestSplit.sweep.cut, first, first + bestSplit.sweep.leftWeight, end)

  /** Swaps the misplaced records on both sides of `middle`: the first with the first, and so on.
    */
  protected def partition(bins: Array[Byte], cut: Int, first: Int, middle: Int, end: Int): Unit =
    partitioner.run(bins, cut, first, middle, end)

  private val partitioner = Partitioner(records)

  protected def narrow(levels: Levels, depth: Int): Unit =
    levels.splitRange(depth, axis, bestSplit.low + (bestSplit.sweep.cut + 1) / bestSplit.scale)

/** Bins of one attempt, with their best split.
  *
  * `low` is the lower bound of the first bin, in twice the coordinate; `scale` is in bins per unit
  * of that.
  */
private[building] final class Slabs:
  val bins: Bins = Bins()
  val sweep: Sweep = Sweep(bins.boxes, bins.counts)
  var low = 0f
  var scale = 0f

private[building] object BinnedCut:
  /** Fraction of the unsplit node's cost; a median split of a planar mesh costs 0.5. */
  inline val Poor = 0.6f

  /** Sample size for choosing an axis, for ranges of more than twice as many records. */
  inline val Sample = 512

/** Multi-threaded counterpart of [[BinnedCut]], with the same result. */
private[building] final class SharedCut(
    records: Array[Int],
    shift: Int,
    binOf: Array[Array[Byte]],
    parallel: Parallel
) extends BinnedCut(records, shift, binOf):

  override protected def fill(
      bins: Bins,
      first: Int,
      end: Int,
      axis: Int,
      low: Float,
      scale: Float
  ): Unit =
    bins.clear()
    parallel.ranges(end - first): (from, until) =>
      val partial = Bins()
      partial.fill(records, binOf(axis), first + from, first + until, axis, low, scale)
      bins.synchronized(bins.add(partial))

  override protected def partition(
      bins: Array[Byte],
      cut: Int,
      first: Int,
      middle: Int,
      end: Int
  ): Unit =
    val chunks = parallel.threads
    if chunks == 1 then super.partition(bins, cut, first, middle, end)
    else
      // Number of misplaced records before each chunk of the left and right parts
      val leftCounts = wrongBefore(bins, first, middle, bin => bin > cut)
      val rightCounts = wrongBefore(bins, middle, end, bin => bin <= cut)
      val pairs = leftCounts(chunks)
      parallel.forEach(chunks): k =>
        var pair = (pairs.toLong * k / chunks).toInt
        val stop = (pairs.toLong * (k + 1) / chunks).toInt
        if pair < stop then
          var i = findMisplaced(bins, first, middle, leftCounts, pair, bin => bin > cut)
          var j = findMisplaced(bins, middle, end, rightCounts, pair, bin => bin <= cut)
          while pair < stop do
            while bins(i) <= cut do i += 1
            while bins(j) > cut do j += 1
            Partitioner.exchange(records, i, j)
            i += 1
            j += 1
            pair += 1

  private def chunkStart(first: Int, end: Int, k: Int): Int =
    first + ((end - first).toLong * k / parallel.threads).toInt

  private inline def wrongBefore(
      bins: Array[Byte],
      first: Int,
      end: Int,
      inline isWrong: Byte => Boolean
  ): Array[Int] =
    val counts = new Array[Int](parallel.threads + 1)
    parallel.forEach(parallel.threads): k =>
      var count = 0
      var i = chunkStart(first, end, k)
      val stop = chunkStart(first, end, k + 1)
      while i < stop do
        if isWrong(bins(i)) then count += 1
        i += 1
      counts(k + 1) = count
    counts.scanLeft(0)(_ + _).tail

  /** Position of the misplaced record with the given rank. */
  private inline def findMisplaced(
      bins: Array[Byte],
      first: Int,
      end: Int,
      before: Array[Int],
      number: Int,
      inline isWrong: Byte => Boolean
  ): Int =
    val chunk = before.lastIndexWhere(_ <= number)
    var remaining = number - before(chunk)
    var i = chunkStart(first, end, chunk)
    while remaining > 0 || !isWrong(bins(i)) do
      if isWrong(bins(i)) then remaining -= 1
      i += 1
    i
