package candela.base

import scala.collection.mutable.ArrayBuffer

/** Growable buffer of unboxed numbers.
  *
  * Stores fixed-size chunks and joins them at the end: peak memory is twice the result, against
  * four times for a doubling array. The first chunk begins small: many buffers hold little.
  *
  * @tparam A array type of the numbers
  */
abstract class NumberBuffer[A](newArray: Int => A):
  private val pieces = ArrayBuffer.empty[A]
  protected var size = 0
  private var firstLength = 0

  def length: Int = size

  /** The chunk that holds the number at index `i`. */
  protected def pieceOf(i: Int): A = pieces(i >>> NumberBuffer.Bits)

  /** Likewise, which is made or enlarged. */
  protected def roomFor(i: Int): A =
    val k = i >>> NumberBuffer.Bits
    if k == NumberBuffer.MaxPieces then throw OutOfMemoryError("a list of more than 2^31 numbers")
    if i >= firstLength && firstLength < NumberBuffer.Piece then enlargeFirst(i)
    while pieces.length <= k do pieces += newArray(NumberBuffer.Piece)
    pieces(k)

  private def enlargeFirst(i: Int): Unit =
    val doubled = 2 * Integer.highestOneBit(Math.min(i, NumberBuffer.Piece - 1))
    val length = Math.max(NumberBuffer.MinPiece, doubled)
    val enlarged = newArray(length)
    if firstLength == 0 then pieces += enlarged
    else
      System.arraycopy(pieces(0), 0, enlarged, 0, firstLength)
      pieces(0) = enlarged
    firstLength = length

  def copyTo(to: A, at: Int): Unit =
    for k <- pieces.indices do
      val start = k << NumberBuffer.Bits
      val count = Math.min(size - start, NumberBuffer.Piece)
      if count > 0 then System.arraycopy(pieces(k), 0, to, at + start, count)

  /** Begins with the numbers of another, whose full chunks are then of both: neither may change
    * them, nor be emptied.
    */
  protected def share(other: NumberBuffer[A]): Unit =
    val full = other.size >>> NumberBuffer.Bits
    pieces ++= other.pieces.take(full)
    if full > 0 then firstLength = NumberBuffer.Piece
    val remaining = other.size & NumberBuffer.OffsetMask
    if remaining > 0 then
      System.arraycopy(other.pieces(full), 0, roomFor(other.size - 1), 0, remaining)
    size = other.size

  /** Empties the buffer, but keeps its memory. */
  def clear(): Unit = size = 0

  /** Returns the numbers and empties the buffer. */
  def drain(): A =
    val result = newArray(size)
    copyTo(result, 0)
    pieces.takeInPlace(1)
    size = 0
    result

object NumberBuffer:
  private[candela] inline val Bits = 12
  private[candela] inline val Piece = 4096
  private inline val MinPiece = 16

  /** Of an index: the bits of the offset in its chunk. */
  private[candela] inline val OffsetMask = 4095

  private inline val MaxPieces = 524287

final class FloatBuffer extends NumberBuffer[Array[Float]](new Array[Float](_)):
  private var last = Array.emptyFloatArray

  def +=(x: Float): Unit =
    val offset = size & NumberBuffer.OffsetMask
    if offset == 0 || offset == last.length then last = roomFor(size)
    last(offset) = x
    size += 1

  def ++=(some: Array[Float]): Unit =
    var start = 0
    while start < some.length do
      val offset = size & NumberBuffer.OffsetMask
      val count = Math.min(some.length - start, NumberBuffer.Piece - offset)
      last = roomFor(size + count - 1)
      System.arraycopy(some, start, last, offset, count)
      start += count
      size += count

  def apply(i: Int): Float = pieceOf(i)(i & NumberBuffer.OffsetMask)
  def update(i: Int, x: Float): Unit = pieceOf(i)(i & NumberBuffer.OffsetMask) = x

final class IntBuffer extends NumberBuffer[Array[Int]](new Array[Int](_)):
  private var last = Array.emptyIntArray

  def +=(x: Int): Unit =
    val offset = size & NumberBuffer.OffsetMask
    if offset == 0 || offset == last.length then last = roomFor(size)
    last(offset) = x
    size += 1

  /** Adds a number so many times. */
  def add(x: Int, count: Int): Unit =
    val end = size + count
    while size < end do
      val offset = size & NumberBuffer.OffsetMask
      val pieceEnd = Math.min(offset + end - size, NumberBuffer.Piece)
      last = roomFor(size - offset + pieceEnd - 1)
      java.util.Arrays.fill(last, offset, pieceEnd, x)
      size += pieceEnd - offset

  /** The same numbers, to which others can be added, while none is changed: see [[share]]. */
  def continued: IntBuffer =
    val next = IntBuffer()
    next.share(this)
    if (size & NumberBuffer.OffsetMask) > 0 then next.last = next.pieceOf(size)
    next

  def apply(i: Int): Int = pieceOf(i)(i & NumberBuffer.OffsetMask)
  def update(i: Int, x: Int): Unit = pieceOf(i)(i & NumberBuffer.OffsetMask) = x

/** What Floats lack of the numbers that they are rounded from: the rounding errors of large ones.
  * Most lists have none.
  */
final class RestBuffer:
  private val rests = FloatBuffer()

  /** Notes the rest of the number at index `i`. */
  def note(i: Int, exact: Double, rounded: Float): Unit =
    val residual = (exact - rounded).toFloat
    if residual != 0f && java.lang.Float.isFinite(residual) then
      while rests.length <= i do rests += 0f
      rests(i) = residual

  /** The rests of `count` numbers, or nothing if there are none; empties the buffer. */
  def drain(count: Int): Array[Float] =
    if rests.length == 0 then Array.emptyFloatArray
    else
      while rests.length < count do rests += 0f
      rests.drain()

object RestBuffer:
  /** Rounding errors of smaller numbers are ignored: Floats are 0.0001 apart here. */
  private inline val MinCoarse = 1024f

  inline def isCoarse(x: Float): Boolean = Math.abs(x) >= MinCoarse

  /** The rests of coordinates that are known in Double. */
  def of(count: Int)(exact: Int => Double): Array[Float] =
    val buffer = RestBuffer()
    loop(count): i =>
      val x = exact(i)
      if isCoarse(x.toFloat) then buffer.note(i, x, x.toFloat)
    buffer.drain(count)
