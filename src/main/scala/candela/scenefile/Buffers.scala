package candela.scenefile

import scala.collection.mutable.ArrayBuffer

/** Floats of a list whose length is not known yet; used again for list after list.
  *
  * They are kept in pieces and joined at the end, which takes memory twice for a moment; an array
  * that doubles takes it up to four times.
  */
final class FloatBuffer:
  private val full = ArrayBuffer.empty[Array[Float]]
  private var piece = new Array[Float](64)
  private var size = 0

  def add(value: Float): Unit =
    if size == piece.length then grow()
    piece(size) = value
    size += 1

  private def grow(): Unit =
    full += piece
    piece = new Array[Float]((piece.length * 2).min(Buffers.LargestPiece))
    size = 0

  /** The values so far; the buffer is empty afterwards. */
  def take(): Array[Float] =
    val values = new Array[Float](Buffers.length(full.iterator.map(_.length), size))
    var at = 0
    for p <- full do
      System.arraycopy(p, 0, values, at, p.length)
      at += p.length
    System.arraycopy(piece, 0, values, at, size)
    full.clear()
    size = 0
    values

/** The same for Ints. */
final class IntBuffer:
  private val full = ArrayBuffer.empty[Array[Int]]
  private var piece = new Array[Int](64)
  private var size = 0

  /** Has a number lost its fraction? */
  var sawFraction = false

  def add(value: Int): Unit =
    if size == piece.length then grow()
    piece(size) = value
    size += 1

  private def grow(): Unit =
    full += piece
    piece = new Array[Int]((piece.length * 2).min(Buffers.LargestPiece))
    size = 0

  /** The values so far; the buffer is empty afterwards. */
  def take(): Array[Int] =
    val values = new Array[Int](Buffers.length(full.iterator.map(_.length), size))
    var at = 0
    for p <- full do
      System.arraycopy(p, 0, values, at, p.length)
      at += p.length
    System.arraycopy(piece, 0, values, at, size)
    full.clear()
    size = 0
    sawFraction = false
    values

private object Buffers:
  val LargestPiece: Int = 1 << 18

  /** Of all pieces together. */
  def length(full: Iterator[Int], last: Int): Int =
    val total = full.map(_.toLong).sum + last
    if total > Int.MaxValue - 8 then throw OutOfMemoryError("a list of more than 2^31 numbers")
    total.toInt
