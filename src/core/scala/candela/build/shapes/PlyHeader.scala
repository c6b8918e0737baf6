package candela.build.shapes

import candela.base.RestBuffer
import java.lang.invoke.{MethodHandles, VarHandle}
import java.nio.ByteOrder
import java.nio.charset.StandardCharsets.ISO_8859_1

import scala.annotation.switch
import scala.collection.mutable

import candela.scenefile.{NumberReader, PlacedText, Source}

/** Number types of PLY files, with their size in bytes in binary files. */
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

/** @param countType type of a list's length; None: the property is a single number */
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

/** Header of a PLY file.
  *
  * @param bodyStart start of the body, in the source's window
  * @param images    names of image files, from the comments that MeshLab writes
  *
  * Source: Turk, "The PLY Polygon File Format", 1994; both generations of type names.
  */
private[build] final case class PlyHeader(
    format: PlyFormat,
    elements: Vector[PlyElement],
    bodyStart: Int,
    images: Vector[PlacedText] = Vector.empty
):
  /** What stands for 1 in numbers of an unsigned type of one or two bytes. */
  def wholes: Map[String, Float] =
    val all = elements.flatMap(_.properties).filter(_.countType.isEmpty)
    all.collect {
      case PlyProperty(name, PlyType.UInt8, _) => name -> 255f
      case PlyProperty(name, PlyType.UInt16, _) => name -> 65535f
    }.toMap

  /** Elements and lists that are not read.
    *
    * @param lists of each element that is read
    */
  def omitted(lists: Map[String, Set[String]]): Vector[String] =
    val (read, unread) = elements.filter(_.count > 0).partition(e => lists.contains(e.name))
    val unreadLists =
      for e <- read; p <- e.properties if p.countType.nonEmpty && !lists(e.name)(p.name)
      yield p.name
    unreadLists ++ unread.map(_.name)

private[build] object PlyHeader:
  private val ObjWords = Set("#", "mtllib", "o", "g", "v")

  /** @param fail reports a problem at a byte offset */
  def read(source: Source, fail: (Long, String) => Nothing): PlyHeader =
    var format = Option.empty[PlyFormat]
    val elements = mutable.ArrayBuffer.empty[PlyElement]
    val images = mutable.ArrayBuffer.empty[PlacedText]
    val lines = Lines(source)
    val first = lines.line()
    if first != "ply" then
      val isObj = ObjWords(first.takeWhile(_ > ' '))
      val hint = if isObj then "; it looks like OBJ: `candela convert` makes PLY of it" else ""
      fail(0, s"not a PLY file, which begins with `ply`$hint")
    var isInHeader = true
    while isInHeader do
      if lines.isAtEnd then
        fail(source.offset(source.limit), "the header must end with `end_header`")
      val line = lines.line()
      def wrong(what: String) =
        val excerpt = line.take(60).map(c => if Character.isISOControl(c) then '?' else c)
        fail(lines.lastStart, s"$what: `$excerpt`")
      words(line) match
        case "format" :: name :: _ =>
          format = Some(Formats.getOrElse(name, wrong("unknown format")))
        case "element" :: name :: count :: Nil =>
          val n = count.toIntOption.filter(_ >= 0).getOrElse(wrong("invalid count"))
          elements += PlyElement(name, n, Vector.empty)
        case "property" :: rest if elements.nonEmpty =>
          val last = elements.last
          val added = property(rest).getOrElse(wrong("unknown property"))
          elements(elements.length - 1) = last.copy(properties = last.properties :+ added)
        case "end_header" :: Nil => isInHeader = false
        case "comment" :: "TextureFile" :: _ :: _ =>
          val name = line.drop(line.indexOf("TextureFile") + "TextureFile".length).trim
          images += PlacedText(name, lines.count, line.indexOf(name) + 1)
        case Nil | ("comment" | "obj_info") :: _ => ()
        case _ => wrong("unknown header line")
    val declaredFormat = format.getOrElse(fail(0, "the header must have a `format`"))
    PlyHeader(declaredFormat, elements.toVector, lines.end, images.toVector)

  private def words(line: String): List[String] =
    val tokens = java.util.StringTokenizer(line, " \t\n\u000b\f\r")
    List.fill(tokens.countTokens)(tokens.nextToken())

  private def property(words: List[String]): Option[PlyProperty] = words match
    case "list" :: count :: value :: name :: Nil =>
      for c <- Types.get(count); v <- Types.get(value) yield PlyProperty(name, v, Some(c))
    case value :: name :: Nil => Types.get(value).map(PlyProperty(name, _, None))
    case _ => None

  /** Splits lines. The end of the first determines the line ending of all: `\n`, `\r\n` or `\r`.
    * Binary numbers may follow the last line, so its end must be exact.
    */
  private final class Lines(source: Source):
    private var next = 0

    /** Start of the body in the source's window, once the last line is read. */
    def end: Int = next
    var lastStart = 0L
    var count = 0

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
      count += 1
      val start = next
      while next < source.limit && bytes(next) != end && next - start < LongestLine do next += 1
      val line = new String(bytes, start, next - start, ISO_8859_1).trim
      next = (next + 1).min(source.limit)
      line

  /** Maximum length of a header line. */
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

/** Sequential reader of the numbers after a PLY header.
  *
  * @param fail reports a problem at a byte offset
  */
private[build] sealed abstract class PlyNumbers(
    source: Source,
    start: Int,
    fail: (Long, String) => Nothing
):
  /** Index of the next byte in the source's window. */
  protected var cursor: Int = start

  /** Byte offset of the next number. */
  def offset: Long = source.offset(cursor)

  /** Reads the next number, of type `t`. */
  def next(t: PlyType): Double

  /** Reads a row of numbers of type Float32; or nothing, and returns false, where they are not all
    * finite or not binary.
    */
  def finiteRow(row: Array[Float]): Boolean = false

  /** Reads a list of three numbers of four bytes, with its length of one byte, as indices below
    * `count`; or nothing, and returns false.
    */
  def triangle(corners: Array[Int], count: Int): Boolean = false

  /** Minimum size of the element in bytes. */
  protected def leastSize(element: PlyElement): Long

  /** Whether the file is large enough for the elements. */
  final def canHold(element: PlyElement): Boolean =
    leastSize(element) <= source.maxAfter(cursor)

  /** Reads the length of a list. */
  final def length(t: PlyType): Int =
    val listStart = offset
    val n = next(t)
    if !(n >= 0 && n <= Int.MaxValue && n == Math.rint(n)) then
      fail(listStart, s"invalid list length ${PlyNumbers.plain(n)}")
    n.toInt

  /** Advances the window to the next byte. */
  protected final def fetch(): Unit =
    source.slide(cursor)
    cursor = 0

  protected final def tooShort(): Nothing =
    fail(source.offset(source.limit), "unexpected end of file")

/** Decimal numbers separated by whitespace. */
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
    while cursor < source.limit && source.bytes(cursor) <= ' ' && source.bytes(cursor) > 0 do
      cursor += 1
    if source.limit - cursor < PlyNumbers.UsualNumber && !source.isLast then
      fetch()
      skipBlank()

  def next(t: PlyType): Double =
    skipBlank()
    if cursor >= source.limit then tooShort()
    var end = number.scan(cursor)
    while number.stop == source.limit && !source.isLast do
      fetch()
      end = number.scan(cursor)
    if end < 0 then fail(offset, "expected a number")
    cursor = end
    val isCoarse = RestBuffer.isCoarse(number.toFloat)
    if t == PlyType.Float32 && !isCoarse then number.toFloat.toDouble else number.toDouble

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
    if source.limit - cursor < size then ensure(size)
    val bytes = source.bytes
    val valueStart = cursor
    cursor += size
    (t.ordinal: @switch) match
      case 0 => bytes(valueStart)
      case 1 => bytes(valueStart) & 0xff
      case 2 => short(bytes, valueStart)
      case 3 => short(bytes, valueStart) & 0xffff
      case 4 => int(bytes, valueStart)
      case 5 => (int(bytes, valueStart) & 0xffffffffL).toDouble
      case 6 => java.lang.Float.intBitsToFloat(int(bytes, valueStart))
      case _ =>
        val (first, second) =
          (int(bytes, valueStart) & 0xffffffffL, int(bytes, valueStart + 4) & 0xffffffffL)
        val bits = if isLittle then second << 32 | first else first << 32 | second
        java.lang.Double.longBitsToDouble(bits)

  override def finiteRow(row: Array[Float]): Boolean =
    hold(4 * row.length) && {
      val bytes = source.bytes
      var isFinite = true
      var i = 0
      while i < row.length do
        val x = java.lang.Float.intBitsToFloat(int(bytes, cursor + 4 * i))
        isFinite &= Math.abs(x) <= Float.MaxValue
        row(i) = x
        i += 1
      if isFinite then cursor += 4 * row.length
      isFinite
    }

  override def triangle(corners: Array[Int], count: Int): Boolean =
    hold(13) && source.bytes(cursor) == 3 && {
      var isInRange = true
      var i = 0
      while i < 3 do
        corners(i) = int(source.bytes, cursor + 1 + 4 * i)
        isInRange &= Integer.compareUnsigned(corners(i), count) < 0
        i += 1
      if isInRange then cursor += 13
      isInRange
    }

  /** Whether there are so many bytes more. */
  private def hold(size: Int): Boolean =
    if source.limit - cursor < size && !source.isLast then fetch()
    source.limit - cursor >= size

  private def ensure(size: Int): Unit = if !hold(size) then tooShort()

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

  /** Bytes that hold almost any number and its separator. */
  private[build] val UsualNumber = 64

  def of(source: Source, header: PlyHeader, fail: (Long, String) => Nothing): PlyNumbers =
    header.format match
      case PlyFormat.Ascii => AsciiPlyNumbers(source, header.bodyStart, fail)
      case PlyFormat.LittleEndian => BinaryPlyNumbers(source, header.bodyStart, true, fail)
      case PlyFormat.BigEndian => BinaryPlyNumbers(source, header.bodyStart, false, fail)

  /** Formats a number, integers without `.0`. */
  def plain(n: Double): String =
    if n == Math.rint(n) && n.abs < 1e15 then n.toLong.toString else n.toString
