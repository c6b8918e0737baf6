package candela.build.shapes

import candela.base.{IntBuffer, loop}

/** Numbers the combinations of three indices that corners of faces have: each is a vertex. */
final class CornerVertices:
  import CornerVertices.Ratio

  private val keys = IntBuffer()
  private var slots = Array.fill(1024)(-1)

  def size: Int = keys.length / 3

  /** The number of a combination; that of a new one is the size before. */
  def apply(a: Int, b: Int, c: Int): Int =
    if 2 * size >= slots.length then grow()
    var slot = hash(a, b, c)
    while slots(slot) >= 0 && !isAt(slots(slot), a, b, c) do slot = (slot + 1) & (slots.length - 1)
    if slots(slot) < 0 then
      slots(slot) = size
      keys += a
      keys += b
      keys += c
    slots(slot)

  /** The indices of a vertex. */
  def first(vertex: Int): Int = keys(3 * vertex)
  def second(vertex: Int): Int = keys(3 * vertex + 1)
  def third(vertex: Int): Int = keys(3 * vertex + 2)

  private def isAt(vertex: Int, a: Int, b: Int, c: Int): Boolean =
    first(vertex) == a && second(vertex) == b && third(vertex) == c

  private def hash(a: Int, b: Int, c: Int): Int =
    // Fibonacci hashing: Knuth, "The Art of Computer Programming", volume 3, section 6.4
    val mixed = ((a * Ratio + b) * Ratio + c) * Ratio
    (mixed >>> (java.lang.Long.numberOfLeadingZeros(slots.length) + 1)).toInt

  private def grow(): Unit =
    slots = Array.fill(2 * slots.length)(-1)
    loop(size): i =>
      var slot = hash(first(i), second(i), third(i))
      while slots(slot) >= 0 do slot = (slot + 1) & (slots.length - 1)
      slots(slot) = i

object CornerVertices:
  /** 2 to the power of 64, divided by the golden ratio. */
  private inline val Ratio = 0x9e3779b97f4a7c15L
