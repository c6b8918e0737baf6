package candela.guiding

import candela.base.{FloatBuffer, IntBuffer, Parallel, loop}

/** Builds the field of some photons. Mutable.
  *
  * @param pool executes divisible work; the field is the same for any
  */
final class PhotonFieldBuilder(photons: FieldPhotons, pool: Parallel):
  import PhotonFieldBuilder.*
  import GuideField.Sides
  private val axis, below = IntBuffer()
  private val split = FloatBuffer()
  private val ends = IntBuffer()

  // Numbers of the photons, in the order of regions
  private val order: Array[Int] = new Array[Int](photons.count)

  def result(): PhotonField =
    loop(Sides)(_ => addNode())
    var begin = 0
    loop(Sides): side =>
      var end = begin
      loop(photons.count): i =>
        if photons.side(i) == side then
          order(end) = i
          end += 1
      val all = Array(-Limit, -Limit, -Limit, Limit, Limit, Limit)
      divide(side, begin, end, all)
      begin = end
    val starts = 0 +: ends.take()
    val regions = starts.length - 1
    val fitted = new Array[Float](photons.count * PhotonField.Size)
    val counts = new Array[Int](regions)
    pool.ranges(regions): (from, until) =>
      val fit = PhotonLobes(photons, order, fitted)
      var region = from
      while region < until do
        counts(region) = fit(starts(region), starts(region + 1))
        region += 1
    val firsts = counts.scanLeft(0)(_ + _)
    val lobes = new Array[Float](firsts.last * PhotonField.Size)
    loop(regions): region =>
      System.arraycopy(
        fitted,
        starts(region) * PhotonField.Size,
        lobes,
        firsts(region) * PhotonField.Size,
        counts(region) * PhotonField.Size
      )
    new PhotonField(RegionTree(axis.take(), split.take(), below.take()), firsts, lobes)

  private def addNode(): Unit =
    axis += 0
    split += 0f
    below += 0

  private def at(i: Int, a: Int): Float = photons.data(order(i) * FieldPhotons.Size + a)

  /** Divides the cell of a node, which has the photons from `begin` to `end`.
    *
    * @param cell its lower and its upper corner
    */
  private def divide(node: Int, begin: Int, end: Int, cell: Array[Float]): Unit =
    if begin == end then leaf(node, end)
    else
      val box = bounds(begin, end)
      val widest = Vector(0, 1, 2).maxBy(a => box(a + 3) - box(a))
      val margin = Margin * (box(widest + 3) - box(widest)) + Rounding * box.map(Math.abs).max
      val gap = (0 until 6).find(k => gapAt(k, cell, box) > Empty * margin)
      gap match
        // What is empty is a region of its own, without photons
        case Some(k) =>
          val isLow = k < 3
          val plane = if isLow then box(k) - margin else box(k) + margin
          val (low, high) = children(node, k % 3, plane)
          val rest = cell.updated(k, plane)
          if isLow then
            leaf(low, begin)
            divide(high, begin, end, rest)
          else
            divide(low, begin, end, rest)
            leaf(high, end)
        case None if end - begin <= MaxPhotons || box(widest + 3) == box(widest) => leaf(node, end)
        case None =>
          val middle = halve(begin, end, widest)
          val plane = (at(middle - 1, widest) + at(middle, widest)) * 0.5f
          val (low, high) = children(node, widest, plane)
          divide(low, begin, middle, cell.updated(widest + 3, plane))
          divide(high, middle, end, cell.updated(widest, plane))

  private def gapAt(k: Int, cell: Array[Float], box: Array[Float]): Float =
    if k < 3 then box(k) - cell(k) else cell(k) - box(k)

  private def bounds(begin: Int, end: Int): Array[Float] =
    val box = Array(Limit, Limit, Limit, -Limit, -Limit, -Limit)
    var i = begin
    while i < end do
      loop(3): a =>
        val x = at(i, a)
        box(a) = Math.min(box(a), x)
        box(a + 3) = Math.max(box(a + 3), x)
      i += 1
    box

  /** Sorts the photons along an axis, as far as halves are concerned; returns the middle. */
  private def halve(begin: Int, end: Int, a: Int): Int =
    val keys = Array.tabulate(end - begin): k =>
      val x = at(begin + k, a)
      val bits = java.lang.Float.floatToIntBits(x + 0f)
      val ordered = if bits < 0 then bits ^ Int.MaxValue else bits
      ordered.toLong << 32 | order(begin + k)
    java.util.Arrays.sort(keys)
    loop(keys.length)(k => order(begin + k) = keys(k).toInt)
    (begin + end) >>> 1

  private def children(node: Int, a: Int, plane: Float): (Int, Int) =
    val first = axis.length
    axis(node) = a
    split(node) = plane
    below(node) = first
    addNode()
    addNode()
    (first, first + 1)

  private def leaf(node: Int, end: Int): Unit =
    below(node) = -1 - ends.length
    ends += end

object PhotonFieldBuilder:
  /** Regions with more photons are split. */
  private[guiding] inline val MaxPhotons = 64

  /** Distance to photons within which a place belongs to them, in widths of all of them. */
  private[guiding] inline val Margin = 0.1f

  /** Likewise, in distances from the origin: photons may all be in one place. */
  private[guiding] inline val Rounding = 1e-5f

  /** Margins of emptiness from which on a cell is cut. */
  private[guiding] inline val Empty = 2.5f
  private[guiding] inline val Limit = Float.MaxValue
