package candela.build.shapes

import java.lang.invoke.{MethodHandles, VarHandle}
import java.nio.ByteOrder
import java.nio.charset.StandardCharsets.ISO_8859_1

import scala.annotation.switch
import scala.collection.mutable

import candela.scenefile.{NumberReader, Source}

/** The number types of PLY files, with their size in bytes where they are binary. */
private[build] enum PlyType(val bytes: Int):
  case Int8 extends PlyType(1)
  case UInt8 extends PlyType(1)
  case Int16 extends PlyType(2)
  case UInt16 extends PlyType(2)
  case Int32 extends PlyType(4)
  case UInt32 extends PlyType(4)
  case Float32 extends PlyType(4)
  case Float64 extends PlyType(8)

private[build] enum PlyFormat:
  case Ascii, LittleEndian, BigEndian

/** @param countType the type of a list's length; None: the property is one number */
private[build] final case class PlyProperty(
    name: String,
    valueType: PlyType,
    countType: Option[PlyType]
)

private[build] final case class PlyElement(
    name: String,
    count: Int,
    properties: Vector[PlyProperty]
)

/** What a PLY file says about itself before its numbers begin.
  *
  * @param bodyStart where they do, in the source's window
  *
  * Source: Turk, "The PLY Polygon File Format", 1994; both generations of type names.
  */
private[build] final case class PlyHeader(
    format: PlyFormat,
    elements: Vector[PlyElement],
    bodyStart: Int
)

private[build] object PlyHeader:

  /** @param fail reports a problem at a byte offset */
  def read(source: Source, fail: (Long, String) => Nothing): PlyHeader =
    var format = Option.empty[PlyFormat]
    val elements = mutable.ArrayBuffer.empty[PlyElement]
    val lines = Lines(source)
    if lines.line() != "ply" then fail(0, "this is no PLY file: it does not begin with `ply`")
    var more = true
    while more do
      if lines.isAtEnd then fail(source.offset(source.limit), "the header has no `end_header`")
      val line = lines.line()
      def wrong(what: String) =
        val shown = line.take(60).map(c => if Character.isISOControl(c) then '?' else c)
        fail(lines.lastStart, s"$what: `$shown`")
      line.split("\\s+").toList match
        case "format" :: name :: _ =>
          format = Some(Formats.getOrElse(name, wrong("unknown format")))
        case "element" :: name :: count :: Nil =>
          val n = count.toIntOption.filter(_ >= 0).getOrElse(wrong("no sensible count"))
          elements += PlyElement(name, n, Vector.empty)
        case "property" :: rest if elements.nonEmpty =>
          val last = elements.last
          val added = property(rest).getOrElse(wrong("unknown property"))
          elements(elements.length - 1) = last.copy(properties = last.properties :+ added)
        case "end_header" :: Nil => more = false
        case ("comment" | "obj_info" | "") :: _ => ()
        case _ => wrong("a header line with no meaning here")
    val known = format.getOrElse(fail(0, "the header has no `format`"))
    PlyHeader(known, elements.toVector, lines.end)

  private def property(words: List[String]): Option[PlyProperty] = words match
    case "list" :: count :: value :: name :: Nil =>
      for c <- Types.get(count); v <- Types.get(value) yield PlyProperty(name, v, Some(c))
    case value :: name :: Nil => Types.get(value).map(PlyProperty(name, _, None))
    case _ => None

  /** Cuts lines. The first shows how all of them end: `\n`, `\r\n` or `\r`. Binary numbers may
    * follow the last, so its end must be known exactly.
    */
  private final class Lines(source: Source):
    private var next = 0

    /** Where the numbers begin, in the source's window, once the last line was read. */
    def end: Int = next
    var lastStart = 0L

    private lazy val endsWithReturn =
      val first = source.bytes.indexWhere(b => b == '\n' || b == '\r')
      def hasPair = first + 1 < source.limit && source.bytes(first + 1) == '\n'
      first >= 0 && source.bytes(first) == '\r' && !hasPair

    def isAtEnd: Boolean = next >= source.limit && source.isLast

    def line(): String =
      while source.limit - next < LongestLine && !source.isLast do
        source.slide(next)
        next = 0
      val bytes = source.bytes
      val end = if endsWithReturn then '\r' else '\n'
      lastStart = source.offset(next)
      val start = next
      while next < source.limit && bytes(next) != end && next - start < LongestLine do next += 1
      val line = new String(bytes, start, next - start, ISO_8859_1).trim
      next = (next + 1).min(source.limit)
      line

  /** Something else than a header, if a line is longer. */
  private val LongestLine = 1 << 16

  private val Formats = Map(
    "ascii" -> PlyFormat.Ascii,
    "binary_little_endian" -> PlyFormat.LittleEndian,
    "binary_big_endian" -> PlyFormat.BigEndian
  )

  private val Types = Map(
    "char" -> PlyType.Int8,
    "int8" -> PlyType.Int8,
    "uchar" -> PlyType.UInt8,
    "uint8" -> PlyType.UInt8,
    "short" -> PlyType.Int16,
    "int16" -> PlyType.Int16,
    "ushort" -> PlyType.UInt16,
    "uint16" -> PlyType.UInt16,
    "int" -> PlyType.Int32,
    "int32" -> PlyType.Int32,
    "uint" -> PlyType.UInt32,
    "uint32" -> PlyType.UInt32,
    "float" -> PlyType.Float32,
    "float32" -> PlyType.Float32,
    "double" -> PlyType.Float64,
    "float64" -> PlyType.Float64
  )

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
