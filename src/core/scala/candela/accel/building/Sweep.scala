package candela.accel.building

/** Finds the cheapest split of a sequence of items by the surface area heuristic: Goldsmith and
  * Salmon, "Automatic Creation of Object Hierarchies", CG&A 7(5), 1987.
  *
  * The running union is in local variables: in an array, each step would wait for the previous
  * step's store. The bounds of both parts are computed on demand, as few splits are used.
  *
  * @param items   their bounds: see [[BoxRecord]]
  * @param weights number of primitives in each item
  */
private[building] final class Sweep(items: Array[Int], weights: Array[Int]):
  /** Half the surface area of the union of each item with all after it. */
  private val areas = new Array[Float](weights.length)

  /** Number of items. */
  private var length = 0

  /** Σ half area · blocks of both parts; infinite without a split. */
  var cost: Float = Float.PositiveInfinity

  /** Last item of the left part; `leftWeight` is that part's weight. */
  var cut = 0
  var leftWeight = 0

  def leftBox(to: Array[Int], at: Int): Unit = union(0, cut + 1, to, at)
  def rightBox(to: Array[Int], at: Int): Unit = union(cut + 1, length, to, at)

  private def union(first: Int, end: Int, to: Array[Int], at: Int): Unit =
    BoxRecord.uniteInto(to, at, items, first, end)

  /** Evaluates the splits of the first `n` items, of total weight `total`.
    *
    * @param shift weights are charged in blocks of 1 << shift, rounded up
    */
  def run(n: Int, total: Int, shift: Int): Unit =
    length = n
    backwards(n)
    forwards(n, total, shift)

  private def backwards(n: Int): Unit =
    val items = this.items
    val areas = this.areas
    var lowX, lowY, lowZ, highX, highY, highZ = BoxRecord.MinusInfinity
    var i = n - 1
    while i > 0 do
      val offset = i * BoxRecord.Ints
      lowX = Math.max(lowX, items(offset))
      lowY = Math.max(lowY, items(offset + 1))
      lowZ = Math.max(lowZ, items(offset + 2))
      highX = Math.max(highX, items(offset + 4))
      highY = Math.max(highY, items(offset + 5))
      highZ = Math.max(highZ, items(offset + 6))
      areas(i) = BoxRecord.halfArea(lowX, lowY, lowZ, highX, highY, highZ)
      i -= 1

  private def forwards(n: Int, total: Int, shift: Int): Unit =
    val items = this.items
    val weights = this.weights
    val areas = this.areas
    var lowX, lowY, lowZ, highX, highY, highZ = BoxRecord.MinusInfinity
    var bestCost = Float.PositiveInfinity
    var bestCut, bestLeft = 0
    var weight = 0
    var i = 0
    while i < n - 1 do
      val offset = i * BoxRecord.Ints
      lowX = Math.max(lowX, items(offset))
      lowY = Math.max(lowY, items(offset + 1))
      lowZ = Math.max(lowZ, items(offset + 2))
      highX = Math.max(highX, items(offset + 4))
      highY = Math.max(highY, items(offset + 5))
      highZ = Math.max(highZ, items(offset + 6))
      weight += weights(i)
      if weight > 0 && weight < total then
        val splitCost =
          BoxRecord.halfArea(lowX, lowY, lowZ, highX, highY, highZ) * Sweep.blocks(weight, shift) +
            areas(i + 1) * Sweep.blocks(total - weight, shift)
        if splitCost < bestCost then
          bestCost = splitCost
          bestCut = i
          bestLeft = weight
      i += 1
    cost = bestCost
    cut = bestCut
    leftWeight = bestLeft

private[building] object Sweep:
  inline def blocks(weight: Int, shift: Int): Int = (weight + (1 << shift) - 1) >> shift
