package candela.accel

import candela.base.loop

/** Builds a binary hierarchy top-down by the surface area heuristic over 16 bins of centroids.
  *
  * Sources: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", RT 2007; the
  * cost model of Goldsmith and Salmon, "Automatic Creation of Object Hierarchies", 1987.
  *
  * @param bounds six Floats a primitive
  */
private[accel] final class BvhBuilder(bounds: Array[Float], maxLeaf: Int):
  private val count = bounds.length / 6

  /** The primitives in leaf order. */
  val order: Array[Int] = Array.range(0, count)

  /** See [[Bvh]] for the layout. */
  var nodes: Array[Float] = new Array[Float](BvhBuilder.NodeFloats * Math.max(1, count))
  var nodeCount = 0

  private val centroids: Array[Float] =
    Array.tabulate(3 * count)(i =>
      0.5f * (bounds(6 * (i / 3) + i % 3) + bounds(6 * (i / 3) + 3 + i % 3))
    )

  private val binCount = new Array[Int](BvhBuilder.Bins)
  private val binBox = new Array[Float](6 * BvhBuilder.Bins)
  private val rightArea = new Array[Float](BvhBuilder.Bins)
  private val rightCount = new Array[Int](BvhBuilder.Bins)

  /** Root of the finished tree: encoded as a child is (see [[Bvh]]). */
  val (root: Int, rootCount: Int) = if count == 0 then (-1, 0) else build(0, count, 0)

  /** Makes the subtree over order[first, end); answers its code and, for a leaf, its size. */
  private def build(first: Int, end: Int, depth: Int): (Int, Int) =
    val n = end - first
    val middle = if n <= 1 then -1 else split(first, end, depth)
    if middle < 0 then (~first, n)
    else
      val node = nodeCount * BvhBuilder.NodeFloats
      nodeCount += 1
      val (left, leftCount) = build(first, middle, depth + 1)
      val (right, rightCount) = build(middle, end, depth + 1)
      unionInto(first, middle, nodes, node)
      unionInto(middle, end, nodes, node + 6)
      nodes(node + 12) = java.lang.Float.intBitsToFloat(left)
      nodes(node + 13) = java.lang.Float.intBitsToFloat(right)
      nodes(node + 14) = java.lang.Float.intBitsToFloat(leftCount)
      nodes(node + 15) = java.lang.Float.intBitsToFloat(rightCount)
      (node, 0)

  private def unionInto(first: Int, end: Int, to: Array[Float], at: Int): Unit =
    clear(to, at)
    var i = first
    while i < end do
      grow(to, at, bounds, 6 * order(i))
      i += 1

  private def clear(box: Array[Float], at: Int): Unit =
    loop(3): k =>
      box(at + k) = Float.PositiveInfinity
      box(at + 3 + k) = Float.NegativeInfinity

  private def grow(box: Array[Float], at: Int, by: Array[Float], from: Int): Unit =
    loop(3): k =>
      if by(from + k) < box(at + k) then box(at + k) = by(from + k)
      if by(from + 3 + k) > box(at + 3 + k) then box(at + 3 + k) = by(from + 3 + k)

  private def halfArea(box: Array[Float], at: Int): Float =
    val x = box(at + 3) - box(at)
    val y = box(at + 4) - box(at + 1)
    val z = box(at + 5) - box(at + 2)
    if x < 0f then 0f else x * y + y * z + z * x

  /** Reorders order[first, end) into two parts and answers where the second begins; −1: make a
    * leaf.
    */
  private def split(first: Int, end: Int, depth: Int): Int =
    val n = end - first
    val low = Array.fill(3)(Float.PositiveInfinity)
    val high = Array.fill(3)(Float.NegativeInfinity)
    var i = first
    while i < end do
      val c = 3 * order(i)
      loop(3): k =>
        if centroids(c + k) < low(k) then low(k) = centroids(c + k)
        if centroids(c + k) > high(k) then high(k) = centroids(c + k)
      i += 1
    val axis = (0 until 3).maxBy(k => high(k) - low(k))
    val extent = high(axis) - low(axis)
    val scale = BvhBuilder.Bins * (1f - 1e-6f) / extent
    // An extent of zero, or so small that its inverse overflows, has no bins
    val isPoint = !(scale < Float.PositiveInfinity)
    if isPoint || depth >= BvhBuilder.MaxSahDepth then
      if n <= maxLeaf then -1 else (first + end) / 2
    else
      fillBins(first, end, axis, low(axis), scale)
      val (bin, cost) = cheapest()
      val whole = new Array[Float](6)
      unionInto(first, end, whole, 0)
      val leafCost = n.toFloat
      val splitCost =
        BvhBuilder.TraversalCost + cost / Math.max(halfArea(whole, 0), Float.MinPositiveValue)
      if n <= maxLeaf && leafCost <= splitCost then -1
      else
        val middle =
          partition(first, end, c => ((centroids(3 * c + axis) - low(axis)) * scale).toInt <= bin)
        if middle == first || middle == end then (first + end) / 2 else middle

  private def fillBins(first: Int, end: Int, axis: Int, low: Float, scale: Float): Unit =
    loop(BvhBuilder.Bins): b =>
      binCount(b) = 0
      clear(binBox, 6 * b)
    var i = first
    while i < end do
      val primitive = order(i)
      val b = ((centroids(3 * primitive + axis) - low) * scale).toInt
      binCount(b) += 1
      grow(binBox, 6 * b, bounds, 6 * primitive)
      i += 1

  /** The last bin of the left part, and Σ area·count of both parts, for the cheapest division. */
  private def cheapest(): (Int, Float) =
    val box = new Array[Float](6)
    clear(box, 0)
    var n = 0
    var b = BvhBuilder.Bins - 1
    while b > 0 do
      grow(box, 0, binBox, 6 * b)
      n += binCount(b)
      rightArea(b - 1) = halfArea(box, 0)
      rightCount(b - 1) = n
      b -= 1
    clear(box, 0)
    n = 0
    var best = 0
    var bestCost = Float.PositiveInfinity
    loop(BvhBuilder.Bins - 1): k =>
      grow(box, 0, binBox, 6 * k)
      n += binCount(k)
      val cost = halfArea(box, 0) * n + rightArea(k) * rightCount(k)
      if n > 0 && rightCount(k) > 0 && cost < bestCost then
        bestCost = cost
        best = k
    (best, bestCost)

  private inline def partition(first: Int, end: Int, inline goesLeft: Int => Boolean): Int =
    var i = first
    var j = end - 1
    while i <= j do
      if goesLeft(order(i)) then i += 1
      else
        val swap = order(i)
        order(i) = order(j)
        order(j) = swap
        j -= 1
    i

private[accel] object BvhBuilder:
  inline val NodeFloats = 16
  inline val Bins = 16

  /** Of a box pair, in units of a primitive test (measured: about one). */
  inline val TraversalCost = 1f

  /** From here on halves, which bounds the depth by this + log2(primitives). */
  inline val MaxSahDepth = 64
