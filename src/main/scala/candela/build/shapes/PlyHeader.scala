package candela.build.shapes

import java.nio.charset.StandardCharsets.ISO_8859_1
import scala.collection.mutable

import candela.scenefile.Source

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
