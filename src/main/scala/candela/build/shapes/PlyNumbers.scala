package candela.build.shapes

import java.lang.invoke.{MethodHandles, VarHandle}
import java.nio.ByteOrder
import scala.annotation.switch

import candela.scenefile.{NumberReader, Source}

/** The numbers after a PLY file's header, one after the other.
  *
  * @param fail reports a problem at a byte offset
  */
private[build] sealed abstract class PlyNumbers(
    source: Source,
    start: Int,
    fail: (Long, String) => Nothing
):
  /** The next byte, in the source's window. */
  protected var at: Int = start

  /** Where the next number is. */
  def offset: Long = source.offset(at)

  /** The next number, which is of that type. */
  def next(t: PlyType): Double

  /** So many bytes hold the element, at least. */
  protected def leastSize(element: PlyElement): Long

  /** Can so many of these elements follow, as far as the file's size tells? */
  final def canHold(element: PlyElement): Boolean =
    leastSize(element) <= source.mostAfter(at)

  /** The next number as the length of a list. */
  final def length(t: PlyType): Int =
    val from = offset
    val n = next(t)
    if !(n >= 0 && n <= Int.MaxValue && n == Math.rint(n)) then
      fail(from, s"a list can't have ${PlyNumbers.plain(n)} values")
    n.toInt

  /** Moves the window on, so that it begins with what is next. */
  protected final def fetch(): Unit =
    source.slide(at)
    at = 0

  protected final def tooShort(): Nothing =
    fail(source.offset(source.limit), "the file ends too early")

/** Decimal numbers between blanks. */
private[build] final class AsciiPlyNumbers(
    source: Source,
    start: Int,
    fail: (Long, String) => Nothing
) extends PlyNumbers(source, start, fail):
  private val number = NumberReader(source)

  override def offset: Long =
    skipBlank()
    super.offset

  private def skipBlank(): Unit =
    while at < source.limit && source.bytes(at) <= ' ' && source.bytes(at) > 0 do at += 1
    if source.limit - at < PlyNumbers.UsualNumber && !source.isLast then
      fetch()
      skipBlank()

  def next(t: PlyType): Double =
    skipBlank()
    if at >= source.limit then tooShort()
    var end = number.scan(at)
    while number.stop == source.limit && !source.isLast do
      fetch()
      end = number.scan(at)
    if end < 0 then fail(offset, "here is no number")
    at = end
    if t == PlyType.Float32 then number.toFloat.toDouble else number.toDouble

  // a digit and a blank for each number, but no blank after the last
  protected def leastSize(element: PlyElement): Long =
    element.count.toLong * element.properties.size * 2 - 1

private[build] final class BinaryPlyNumbers(
    source: Source,
    start: Int,
    isLittle: Boolean,
    fail: (Long, String) => Nothing
) extends PlyNumbers(source, start, fail):

  def next(t: PlyType): Double =
    val size = t.bytes
    if source.limit - at < size then need(size)
    val bytes = source.bytes
    val from = at
    at += size
    (t.ordinal: @switch) match
      case 0 => bytes(from)
      case 1 => bytes(from) & 0xff
      case 2 => short(bytes, from)
      case 3 => short(bytes, from) & 0xffff
      case 4 => int(bytes, from)
      case 5 => (int(bytes, from) & 0xffffffffL).toDouble
      case 6 => java.lang.Float.intBitsToFloat(int(bytes, from))
      case _ =>
        val (first, second) = (int(bytes, from) & 0xffffffffL, int(bytes, from + 4) & 0xffffffffL)
        val bits = if isLittle then second << 32 | first else first << 32 | second
        java.lang.Double.longBitsToDouble(bits)

  private def need(size: Int): Unit =
    if !source.isLast then fetch()
    if source.limit - at < size then tooShort()

  private def short(bytes: Array[Byte], i: Int): Short =
    if isLittle then (bytes(i) & 0xff | bytes(i + 1) << 8).toShort
    else (bytes(i) << 8 | bytes(i + 1) & 0xff).toShort

  private def int(bytes: Array[Byte], i: Int): Int =
    val little: Int = PlyNumbers.Words.get(bytes, i)
    if isLittle then little else Integer.reverseBytes(little)

  protected def leastSize(element: PlyElement): Long =
    element.count * element.properties.map(p => p.countType.getOrElse(p.valueType).bytes.toLong).sum

private[build] object PlyNumbers:
  private[build] val Words: VarHandle =
    MethodHandles.byteArrayViewVarHandle(classOf[Array[Int]], ByteOrder.LITTLE_ENDIAN)

  /** So many bytes hold almost every number and what ends it. */
  private[build] val UsualNumber = 64

  def of(source: Source, header: PlyHeader, fail: (Long, String) => Nothing): PlyNumbers =
    header.format match
      case PlyFormat.Ascii => AsciiPlyNumbers(source, header.bodyStart, fail)
      case PlyFormat.LittleEndian => BinaryPlyNumbers(source, header.bodyStart, true, fail)
      case PlyFormat.BigEndian => BinaryPlyNumbers(source, header.bodyStart, false, fail)

  /** Without `.0` where it is whole. */
  def plain(n: Double): String =
    if n == Math.rint(n) && n.abs < 1e15 then n.toLong.toString else n.toString
