package candela.accel

/** Divides many records, between two of sixteen slabs.
  *
  * It is a cut across the axis along which centres are spread widest. Only if that is a poor one,
  * the two others are tried, too: in meshes this is rare and so costs little, yet the trees are
  * better than if it is never done (docs/decisions/0012).
  *
  * @param shift see [[Sweep]]
  * @param binOf for each axis the bin of each record, if it was filled last
  */
private[accel] class BinnedCut(records: Array[Int], shift: Int, binOf: Array[Array[Byte]])
    extends Cut:
  private var best = Sweep(Bins.Count)
  private var trial = Sweep(Bins.Count)
  protected val bins: Bins = Bins()
  private val lows = new Array[Float](3)
  private val scales = new Array[Float](3)
  private var axis = 0

  protected def sweep: Sweep = best

  def find(first: Int, end: Int, levels: Levels, depth: Int): Boolean =
    levels.tighten(depth)
    attemptWidest(first, end, levels, depth)
    if best.cost == Float.PositiveInfinity then
      // All centres may be in one bin of a range that was taken too wide
      levels.measure(depth, records, first, end)
      attemptWidest(first, end, levels, depth)
    val area = BoxRecord.halfArea(levels.boxes, depth * BoxRecord.Ints)
    if best.cost > BinnedCut.Poor * Sweep.blocks(end - first, shift) * area then
      val widest = axis
      var k = 0
      while k < 3 do
        if k != widest then
          attempt(first, end, k, levels, depth)
          if trial.cost < best.cost then
            swap()
            axis = k
        k += 1
    best.cost < Float.PositiveInfinity

  private def attemptWidest(first: Int, end: Int, levels: Levels, depth: Int): Unit =
    axis = levels.widest(depth)
    attempt(first, end, axis, levels, depth)
    swap()

  private def swap(): Unit =
    val was = best
    best = trial
    trial = was

  private def attempt(first: Int, end: Int, axis: Int, levels: Levels, depth: Int): Unit =
    val low = levels.low(depth, axis)
    val scale = Bins.Count / levels.extent(depth, axis)
    trial.cost = Float.PositiveInfinity
    // A point, or one so small that its inverse overflows, has no slabs; nor has infinity
    if scale > 0f && scale < Float.PositiveInfinity then
      fill(first, end, axis, low, scale)
      trial.run(bins.boxes, bins.counts, Bins.Count, end - first, shift)
      levels.clip(depth, axis, low + bins.firstUsed / scale, low + (bins.lastUsed + 1) / scale)
      lows(axis) = low
      scales(axis) = scale

  /** Fills the bins. */
  protected def fill(first: Int, end: Int, axis: Int, low: Float, scale: Float): Unit =
    bins.fill(records, binOf(axis), first, end, axis, low, scale)

  def divide(first: Int, end: Int): Unit =
    partition(binOf(axis), best.cut, first, first + best.left, end)

  /** Exchanges the records left of `middle` that belong to its right with those right of it that
    * belong to its left: the first with the first, and so on.
    */
  protected def partition(bins: Array[Byte], cut: Int, first: Int, middle: Int, end: Int): Unit =
    partitioner.run(bins, cut, first, middle, end)

  private val partitioner = Partitioner(records)

  protected def narrow(levels: Levels, depth: Int): Unit =
    levels.part(depth, axis, lows(axis) + (best.cut + 1) / scales(axis))

private[accel] object BinnedCut:
  /** Of the cost of a node that isn't divided: a cut in half through a plane mesh leaves 0.5. */
  inline val Poor = 0.6f
