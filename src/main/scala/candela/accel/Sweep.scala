package candela.accel

/** Finds the cheapest cut through items that stand in a row, by the surface area heuristic:
  * Goldsmith and Salmon, "Automatic Creation of Object Hierarchies", CG&A 7(5), 1987.
  *
  * The union so far is in local variables: in an array each step would wait for the last one's
  * writing.
  *
  * @param most items
  */
private[accel] final class Sweep(most: Int):
  /** The union of each item's box with all before it, and with all after it. */
  private val upTo = new Array[Int](BoxRecord.Ints * most)
  private val from = new Array[Int](BoxRecord.Ints * most)
  private val areas = new Array[Float](most)

  /** Σ half area · blocks of both parts; infinite if there is no cut. */
  var cost: Float = Float.PositiveInfinity

  /** The last item of the left part, and the weight of that part. */
  var cut = 0
  var left = 0

  def leftBox(to: Array[Int], at: Int): Unit =
    BoxRecord.copy(upTo, cut * BoxRecord.Ints, to, at)

  def rightBox(to: Array[Int], at: Int): Unit =
    BoxRecord.copy(from, (cut + 1) * BoxRecord.Ints, to, at)

  /** Looks at the boxes of `n` items, which weigh `total` together.
    *
    * @param shift weights are paid for in blocks of 1 << shift, begun ones as whole ones
    */
  def run(items: Array[Int], weights: Array[Int], n: Int, total: Int, shift: Int): Unit =
    backwards(items, n)
    forwards(items, weights, n, total, shift)

  private def backwards(items: Array[Int], n: Int): Unit =
    val from = this.from
    val areas = this.areas
    var lowX, lowY, lowZ, highX, highY, highZ = BoxRecord.Least
    var i = n - 1
    while i > 0 do
      val at = i * BoxRecord.Ints
      lowX = Math.max(lowX, items(at))
      lowY = Math.max(lowY, items(at + 1))
      lowZ = Math.max(lowZ, items(at + 2))
      highX = Math.max(highX, items(at + 4))
      highY = Math.max(highY, items(at + 5))
      highZ = Math.max(highZ, items(at + 6))
      BoxRecord.set(from, at, lowX, lowY, lowZ, highX, highY, highZ)
      areas(i) = BoxRecord.halfArea(lowX, lowY, lowZ, highX, highY, highZ)
      i -= 1

  private def forwards(
      items: Array[Int],
      weights: Array[Int],
      n: Int,
      total: Int,
      shift: Int
  ): Unit =
    val upTo = this.upTo
    val areas = this.areas
    var lowX, lowY, lowZ, highX, highY, highZ = BoxRecord.Least
    var bestCost = Float.PositiveInfinity
    var weight = 0
    var i = 0
    while i < n - 1 do
      val at = i * BoxRecord.Ints
      lowX = Math.max(lowX, items(at))
      lowY = Math.max(lowY, items(at + 1))
      lowZ = Math.max(lowZ, items(at + 2))
      highX = Math.max(highX, items(at + 4))
      highY = Math.max(highY, items(at + 5))
      highZ = Math.max(highZ, items(at + 6))
      BoxRecord.set(upTo, at, lowX, lowY, lowZ, highX, highY, highZ)
      weight += weights(i)
      if weight > 0 && weight < total then
        val here =
          BoxRecord.halfArea(lowX, lowY, lowZ, highX, highY, highZ) * Sweep.blocks(weight, shift) +
            areas(i + 1) * Sweep.blocks(total - weight, shift)
        if here < bestCost then
          bestCost = here
          cut = i
          left = weight
      i += 1
    cost = bestCost

private[accel] object Sweep:
  inline def blocks(weight: Int, shift: Int): Int = (weight + (1 << shift) - 1) >> shift
