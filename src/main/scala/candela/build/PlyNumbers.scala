package candela.build

import java.nio.{ByteBuffer, ByteOrder}

import candela.scenefile.NumberReader

/** The numbers after a PLY file's header, one after the other.
  *
  * @param fail reports a problem at a byte offset
  */
private[build] sealed abstract class PlyNumbers(fail: (Int, String) => Nothing):

  /** The offset of the next number. */
  def offset: Int

  /** The next number, which is of that type. */
  def next(t: PlyType): Double

  /** Can so many of these elements follow, as far as the file's size tells? */
  def canHold(element: PlyElement): Boolean

  /** The next number as the length of a list. */
  final def length(t: PlyType): Int =
    val at = offset
    val n = next(t)
    if !(n >= 0 && n <= Int.MaxValue && n == Math.rint(n)) then
      fail(at, s"a list can't have ${PlyNumbers.plain(n)} values")
    n.toInt

/** Decimal numbers between blanks. */
private[build] final class AsciiPlyNumbers(
    bytes: Array[Byte],
    start: Int,
    fail: (Int, String) => Nothing
) extends PlyNumbers(fail):
  private val number = NumberReader(bytes)
  private var at = start

  def offset: Int =
    while at < bytes.length && bytes(at) <= ' ' && bytes(at) > 0 do at += 1
    at

  def next(t: PlyType): Double =
    val from = offset
    if from >= bytes.length then fail(bytes.length, "the file ends too early")
    val end = number.scan(from)
    if end < 0 then fail(from, "here is no number")
    at = end
    if t == PlyType.Float32 then number.toFloat.toDouble else number.toDouble

  // a digit and a blank for each number, but no blank after the last
  def canHold(element: PlyElement): Boolean =
    element.count.toLong * element.properties.size * 2 - 1 <= bytes.length - at

private[build] final class BinaryPlyNumbers(
    bytes: Array[Byte],
    start: Int,
    order: ByteOrder,
    fail: (Int, String) => Nothing
) extends PlyNumbers(fail):
  private val buffer = ByteBuffer.wrap(bytes).order(order)
  private var at = start

  def offset: Int = at

  def next(t: PlyType): Double =
    val from = at
    if from + t.bytes > bytes.length then fail(bytes.length, "the file ends too early")
    at = from + t.bytes
    t match
      case PlyType.Float32 => buffer.getFloat(from).toDouble
      case PlyType.Int32 => buffer.getInt(from).toDouble
      case PlyType.UInt8 => (bytes(from) & 0xff).toDouble
      case PlyType.Int8 => bytes(from).toDouble
      case PlyType.Int16 => buffer.getShort(from).toDouble
      case PlyType.UInt16 => (buffer.getShort(from) & 0xffff).toDouble
      case PlyType.UInt32 => (buffer.getInt(from) & 0xffffffffL).toDouble
      case PlyType.Float64 => buffer.getDouble(from)

  def canHold(element: PlyElement): Boolean =
    val size = element.properties.map(p => p.countType.getOrElse(p.valueType).bytes.toLong).sum
    element.count * size <= bytes.length - at

private[build] object PlyNumbers:

  def of(
      bytes: Array[Byte],
      header: PlyHeader,
      fail: (Int, String) => Nothing
  ): PlyNumbers = header.format match
    case PlyFormat.Ascii => AsciiPlyNumbers(bytes, header.bodyStart, fail)
    case PlyFormat.LittleEndian =>
      BinaryPlyNumbers(bytes, header.bodyStart, ByteOrder.LITTLE_ENDIAN, fail)
    case PlyFormat.BigEndian =>
      BinaryPlyNumbers(bytes, header.bodyStart, ByteOrder.BIG_ENDIAN, fail)

  /** Without `.0` where it is whole. */
  def plain(n: Double): String =
    if n == Math.rint(n) && n.abs < 1e15 then n.toLong.toString else n.toString
