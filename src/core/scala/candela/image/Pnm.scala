package candela.image

import candela.base.loop
import candela.diagnostics.Code
import candela.color.Encoding

import java.nio.charset.StandardCharsets.US_ASCII

/** Reads portable bitmaps, grey maps and pixmaps, in numerals (`P1` to `P3`) or binary (`P4` to
  * `P6`), of any maximum up to 65535. The maximum is white.
  *
  * Source: netpbm.sourceforge.net, "PPM", "PGM" and "PBM Format Specification".
  */
private[image] object Pnm:

  def isMark(file: Array[Byte]): Boolean =
    file.length > 2 && file(0) == 'P' && file(1) >= '1' && file(1) <= '6' &&
      (isBlank(file(2)) || file(2) == '#')

  def read(file: Array[Byte]): StoredImage = Reader(file).image()

  /** How pbrt-v4 reads the file differently, if it does. */
  def remark(file: Array[Byte]): Option[String] =
    try
      Option.when(isMark(file))(Reader(file)).flatMap: reader =>
        if !reader.isBinary || reader.isBits then
          Some("pbrt-v4 can't read it: only PGM and PPM files of bytes, P5 and P6")
        else
          Some(reader.header().maxValue).filter(_ != 255).map: maxValue =>
            s"its values are at most $maxValue, which is white; pbrt-v4 takes 255 for white" +
              (if maxValue > 255 then ", and the lower byte of each value" else "")
    catch case _: ImageError => None

  private final case class Header(width: Int, height: Int, maxValue: Int)

  private def isBlank(b: Byte) = b == ' ' || (b >= '\t' && b <= '\r')

  private final class Reader(file: Array[Byte]):
    private val kind = file(1) - '0'
    val isBits = kind == 1 || kind == 4
    val isBinary = kind >= 4
    private val names = if kind % 3 == 0 then Image.RgbNames else Vector("Y")
    private var cursor = 2

    def header(): Header =
      val (width, height) = (number("width", Int.MaxValue), number("height", Int.MaxValue))
      val maxValue = if isBits then 1 else number("maximum", 65535)
      if width < 1 || height < 1 || maxValue < 1 then
        throw ImageError(
          Code.DamagedImage,
          s"expected sizes and a maximum above 0, found $width $height $maxValue"
        )
      Header(width, height, maxValue)

    def image(): StoredImage =
      val Header(width, height, maxValue) = header()
      val row = width.toLong * names.size
      val count = row * height
      // A single blank ends the header of binary files
      if isBinary then cursor += 1
      val bytesOfRow = if isBits then (row + 7) / 8 else if maxValue > 255 then 2 * row else row
      val minBytes = if isBinary then bytesOfRow * height else count
      val available = Math.max(file.length - cursor, 0)
      if minBytes > available || count > Int.MaxValue - 8 then
        throw ImageError(
          Code.DamagedImage,
          s"$width×$height pixels need $minBytes bytes, found $available"
        )
      val start = cursor
      def value(i: Int): Int =
        if !isBinary then if isBits then bit() else number("value", 65535)
        else if isBits then
          val (y, x) = (i / width, i % width)
          file((start + y * bytesOfRow + x / 8).toInt) >> (7 - x % 8) & 1
        else if maxValue > 255 then
          (file(start + 2 * i) & 0xff) << 8 | (file(start + 2 * i + 1) & 0xff)
        else file(start + i) & 0xff
      if maxValue == 255 || isBits then
        val bytes = new Array[Byte](count.toInt)
        // 1 is black in bitmaps
        if isBits then loop(bytes.length)(i => bytes(i) = (255 * (1 - value(i))).toByte)
        else loop(bytes.length)(i => bytes(i) = Math.min(value(i), 255).toByte)
        ByteImage(width, height, names, bytes, Encoding.Srgb)
      else
        val data = new Array[Float](count.toInt)
        loop(data.length)(i => data(i) = Math.min(value(i), maxValue) / maxValue.toFloat)
        Image(width, height, names, data, Encoding.Srgb)

    /** A numeral after blanks and comments. */
    private def number(quantity: String, largest: Int): Int =
      skip()
      val start = cursor
      while cursor < file.length && cursor - start < 10 && file(cursor) >= '0' && file(
          cursor
        ) <= '9'
      do cursor += 1
      val text = String(file, start, cursor - start, US_ASCII)
      text.toIntOption.filter(_ <= largest).getOrElse:
        val quoted = String(file, start, Math.min(file.length - start, 10), US_ASCII)
        throw ImageError(
          Code.DamagedImage,
          s"expected its $quantity, at most $largest, found `${quoted.trim}`"
        )

    /** Bits need no blanks between them. */
    private def bit(): Int =
      skip()
      if cursor == file.length || (file(cursor) != '0' && file(cursor) != '1') then
        throw ImageError(Code.DamagedImage, "expected bits, 0 or 1, for all of its pixels")
      cursor += 1
      file(cursor - 1) - '0'

    private def skip(): Unit =
      while cursor < file.length && (isBlank(file(cursor)) || file(cursor) == '#') do
        if file(cursor) == '#' then
          while cursor < file.length && file(cursor) != '\n' && file(cursor) != '\r' do cursor += 1
        else cursor += 1
