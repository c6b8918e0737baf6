package candela.shapes

import candela.base.{IntBuffer, loop}

/** Indices of vertices, three for each triangle. Indices that follow each other are mostly near
  * each other: a group of them has its least as an Int, and the differences to it in 16 bits, which
  * halves the memory. A group that reaches farther has Ints.
  *
  * @param bases the least index of each group; below 0: the complement of where its Ints begin
  * @param lows  what each index is above the least of its group
  * @param ints  of the other groups
  */
final class VertexIndices private (
    val length: Int,
    bases: Array[Int],
    lows: Array[Char],
    ints: Array[Int]
):
  import VertexIndices.*

  def apply(i: Int): Int =
    val base = bases(i >> Bits)
    if base >= 0 then base + lows(i) else ints(~base + (i & Group - 1))

  /** Some of them, in memory of their own. */
  def slice(from: Int, until: Int): Array[Int] =
    val copied = new Array[Int](until - from)
    loop(copied.length)(i => copied(i) = apply(from + i))
    copied

  /** The size of all arrays. */
  private[shapes] def bytes: Long = 4L * bases.length + 2L * lows.length + 4L * ints.length

object VertexIndices:
  private inline val Bits = 6
  private inline val Group = 64

  def apply(indices: Array[Int]): VertexIndices = joined(Iterator((indices, 0)), indices.length)

  /** The indices of pieces, each raised by a number.
    *
    * @param count of all
    */
  def joined(pieces: Iterator[(Array[Int], Int)], count: Int): VertexIndices =
    val packer = Packer(count)
    for (indices, by) <- pieces do packer.add(indices, by)
    packer.result()

  private def groups(count: Int): Int = (count + Group - 1) >> Bits

  private final class Packer(count: Int):
    private val bases = new Array[Int](groups(count))
    private val lows = new Array[Char](count)
    private val far = IntBuffer()
    private val group = new Array[Int](Group)
    private var position = 0

    def add(indices: Array[Int], by: Int): Unit =
      loop(indices.length): i =>
        group(position & Group - 1) = indices(i) + by
        position += 1
        if (position & Group - 1) == 0 then pack(Group)

    /** Packs the latest `n` indices, a group. */
    private def pack(n: Int): Unit =
      val first = position - n
      var lowest, highest = group(0)
      loop(n): k =>
        lowest = Math.min(lowest, group(k))
        highest = Math.max(highest, group(k))
      if highest - lowest <= Char.MaxValue then
        bases(first >> Bits) = lowest
        loop(n)(k => lows(first + k) = (group(k) - lowest).toChar)
      else
        bases(first >> Bits) = ~far.length
        loop(n)(k => far += group(k))

    def result(): VertexIndices =
      if (position & Group - 1) != 0 then pack(position & Group - 1)
      val packed = new VertexIndices(count, bases, lows, far.drain())
      // Where most groups are far, their places among the near ones would be wasted
      if packed.bytes <= 4L * count then packed
      else
        val starts = Array.tabulate(groups(count))(g => ~(g << Bits))
        new VertexIndices(count, starts, Array.emptyCharArray, packed.slice(0, count))
