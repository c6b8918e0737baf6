package candela.accel

import candela.base.Parallel

/** As [[BinnedCut]], with several threads for each division; the same comes out. */
private[accel] final class SharedCut(
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
      val some = Bins()
      some.fill(records, binOf(axis), first + from, first + until, axis, low, scale)
      bins.synchronized(bins.add(some))

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
      // How many records are on the wrong side before each chunk of the left part, and of the right
      val left = wrongBefore(bins, first, middle, bin => bin > cut)
      val right = wrongBefore(bins, middle, end, bin => bin <= cut)
      val pairs = left(chunks)
      parallel.each(chunks): k =>
        var pair = (pairs.toLong * k / chunks).toInt
        val stop = (pairs.toLong * (k + 1) / chunks).toInt
        if pair < stop then
          var i = find(bins, first, middle, left, pair, bin => bin > cut)
          var j = find(bins, middle, end, right, pair, bin => bin <= cut)
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
    parallel.each(parallel.threads): k =>
      var count = 0
      var i = chunkStart(first, end, k)
      val stop = chunkStart(first, end, k + 1)
      while i < stop do
        if isWrong(bins(i)) then count += 1
        i += 1
      counts(k + 1) = count
    counts.scanLeft(0)(_ + _).tail

  /** Where the wrong record of that number is. */
  private inline def find(
      bins: Array[Byte],
      first: Int,
      end: Int,
      before: Array[Int],
      number: Int,
      inline isWrong: Byte => Boolean
  ): Int =
    val chunk = before.lastIndexWhere(_ <= number)
    var left = number - before(chunk)
    var i = chunkStart(first, end, chunk)
    while left > 0 || !isWrong(bins(i)) do
      if isWrong(bins(i)) then left -= 1
      i += 1
    i
