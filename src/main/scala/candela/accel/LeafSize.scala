package candela.accel

/** How many primitives a leaf of the binary tree may have.
  *
  * Triangles of one block are tested at the cost of one, so a range that fits into a block is not
  * divided, and cuts are priced by the blocks that they leave, as in Wald, Woop, Benthin, Johnson,
  * Ernst, "Embree: A Kernel Framework for Efficient CPU Ray Tracing", TOG 33(4), 2014.
  *
  * @param most    primitives of any kind, if that is cheaper than to divide them
  * @param block   triangles of a block, a power of two; 1: there are none
  * @param isPlain may this primitive be in a block?
  */
private[accel] final class LeafSize(val most: Int, val block: Int, isPlain: Int => Boolean):
  /** For what [[Sweep]] prices a cut by: log2 of `block`. */
  val shift: Int = Integer.numberOfTrailingZeros(block)

  /** Are these records no more than a block? */
  def isBlock(records: Array[Int], first: Int, end: Int): Boolean =
    var i = first
    if end - first <= block then
      while i < end && isPlain(records(i * BoxRecord.Ints + BoxRecord.Number)) do i += 1
    i == end

private[accel] object LeafSize:
  /** Each primitive is tested for itself. */
  def single(most: Int): LeafSize = LeafSize(most, 1, _ => true)
