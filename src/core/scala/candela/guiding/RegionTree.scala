package candela.guiding

/** Space divided into regions, separately for each side ([[GuideField.side]]), by planes across the
  * axes. Immutable.
  *
  * @param axis  of each node of space that is divided: 0, 1 or 2; the first seven are the roots
  * @param split where it is divided
  * @param below first of its two children, which follow each other; of a leaf −1 − its region
  */
private[guiding] final class RegionTree(axis: Array[Int], split: Array[Float], below: Array[Int]):
  /** The region of the point whose coordinates begin at `p(at)`, on a surface that faces this side;
    * points outside belong to the nearest.
    */
  def region(side: Int, p: Array[Float], at: Int): Int =
    var node = side
    var next = below(node)
    while next >= 0 do
      // Without branches, which would be predicted wrongly
      node = next + (if p(at + axis(node)) < split(node) then 0 else 1)
      next = below(node)
    -1 - next
