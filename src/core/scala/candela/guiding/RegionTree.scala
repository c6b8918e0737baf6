package candela.guiding

import candela.base.loop

/** Space divided into regions, separately for each side ([[GuideField.side]]), by planes across the
  * axes. Immutable.
  *
  * @param axis  of each node of space that is divided: 0, 1 or 2; the first seven are the roots
  * @param split where it is divided
  * @param below first of its two children, which follow each other; of a leaf −1 − its region
  */
private[guiding] final class RegionTree(axis: Array[Int], split: Array[Float], below: Array[Int]):
  import RegionTree.*

  // Beside each other, so that each step waits for memory once
  private val nodes = new Array[Int](axis.length * Size)
  loop(axis.length): i =>
    nodes(i * Size) = below(i)
    nodes(i * Size + Axis) = axis(i)
    nodes(i * Size + Split) = java.lang.Float.floatToRawIntBits(split(i))

  /** The region of the point whose coordinates begin at `p(at)`, on a surface that faces this side;
    * points outside belong to the nearest.
    */
  def region(side: Int, p: Array[Float], at: Int): Int =
    var node = side * Size
    var next = nodes(node)
    while next >= 0 do
      // Without branches, which would be predicted wrongly
      val isBelow = p(at + nodes(node + Axis)) < java.lang.Float.intBitsToFloat(nodes(node + Split))
      node = (next + (if isBelow then 0 else 1)) * Size
      next = nodes(node)
    -1 - next

private object RegionTree:
  /** Numbers of a node: first of its children, axis, place of the plane. A power of two, so that no
    * node lies in two cache lines.
    */
  inline val Size = 4
  inline val Axis = 1
  inline val Split = 2
