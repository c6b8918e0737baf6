package candela.image

import candela.base.loop
import candela.diagnostics.Code
import candela.io.InputFile
import java.io.{DataInputStream, EOFException, InputStream, IOException}
import java.util.zip.{CRC32, DataFormatException, Inflater}

import scala.util.Using

import candela.color.{ColorSpace, Encoding}

/** A PNG file of 8 or 16 bits, neither interlaced nor with a palette or a transparent colour: the
  * pixels that [[StbReader]] reads, in bands.
  *
  * Source: "Portable Network Graphics (PNG) Specification (Second Edition)", W3C, 2003: §5.3 and
  * §5.4 on chunks, §9 on filters, §10 on compression, §11.2.2 on IHDR.
  */
private[image] final class PngBands private (
    file: InputFile,
    w: Int,
    h: Int,
    names: Vector[String],
    bytesPerValue: Int
) extends ImageBands(w, h, names, Encoding.Srgb, ColorSpace.Srgb, bytesPerValue == 1):
  private val pixel = names.size * bytesPerValue
  private val values = w * names.size

  def visit(band: (Int, StoredImage) => Boolean): Unit =
    try
      Using.resource(file.again()): stream =>
        Using.resource(PngData(stream))(visit(_, band))
    catch
      case _: EOFException => throw damaged("it ends early")
      case e: DataFormatException => throw damaged(s"${e.getMessage}")
      case e: IOException =>
        throw ImageError(Code.Unreadable, s"$file: can't be read: ${e.getMessage}")

  private def visit(data: PngData, band: (Int, StoredImage) => Boolean): Unit =
    val row = new Array[Byte](w * pixel)
    val above = new Array[Byte](w * pixel)
    val rows = Math.min(h, ImageBands.Rows)
    val bytes = if isBytes then new Array[Byte](rows * values) else Array.emptyByteArray
    val floats = if isBytes then Array.emptyFloatArray else new Array[Float](rows * values)
    var y = 0
    var goesOn = true
    while goesOn && y < h do
      val inBand = y % ImageBands.Rows
      val filter = data.byte()
      data.read(row)
      unfilter(filter, row, above)
      if isBytes then System.arraycopy(row, 0, bytes, inBand * values, values)
      else
        loop(values): i =>
          val value = (row(2 * i) & 0xff) << 8 | row(2 * i + 1) & 0xff
          floats(inBand * values + i) = value / 65535f
      System.arraycopy(row, 0, above, 0, row.length)
      y += 1
      if inBand == ImageBands.Rows - 1 || y == h then
        goesOn = band(y - 1 - inBand, image(bytes, floats, inBand + 1))
    if goesOn then data.end()

  private def image(bytes: Array[Byte], floats: Array[Float], rows: Int): StoredImage =
    val count = rows * values
    if isBytes then ByteImage(w, rows, names, prefix(bytes, count), encoding)
    else
      val trimmed = if floats.length == count then floats else floats.take(count)
      Image(w, rows, names, trimmed, encoding)

  private def prefix(bytes: Array[Byte], count: Int): Array[Byte] =
    if bytes.length == count then bytes else bytes.take(count)

  private def unfilter(filter: Int, row: Array[Byte], above: Array[Byte]): Unit =
    val length = row.length
    filter match
      case 0 => ()
      case 1 =>
        var i = pixel
        while i < length do
          row(i) = (row(i) + row(i - pixel)).toByte
          i += 1
      case 2 =>
        var i = 0
        while i < length do
          row(i) = (row(i) + above(i)).toByte
          i += 1
      case 3 =>
        var i = 0
        while i < length do
          val leftByte = if i < pixel then 0 else row(i - pixel) & 0xff
          row(i) = (row(i) + ((leftByte + (above(i) & 0xff)) >> 1)).toByte
          i += 1
      case 4 =>
        var i = 0
        while i < Math.min(pixel, length) do
          row(i) = (row(i) + above(i)).toByte
          i += 1
        while i < length do
          val a = row(i - pixel) & 0xff
          val b = above(i) & 0xff
          val c = above(i - pixel) & 0xff
          row(i) = (row(i) + paeth(a, b, c)).toByte
          i += 1
      case _ => throw damaged("a row has an unknown filter")

  /** The neighbour that is nearest to `a + b − c`. */
  private def paeth(a: Int, b: Int, c: Int): Int =
    val ofA = Math.abs(b - c)
    val ofB = Math.abs(a - c)
    val ofC = Math.abs(a + b - 2 * c)
    if ofA <= ofB && ofA <= ofC then a else if ofB <= ofC then b else c

  private def damaged(reason: String) = ImageError(Code.DamagedImage, s"$file: $reason")

private[image] object PngBands:
  /** Channels by colour type. */
  private val Names = (StbReader.PngChannels - StbReader.Palette).map: (kind, count) =>
    kind -> StbReader.Names(count - 1)

  /** Bytes of the signature and the chunk IHDR. */
  private[image] val Beginning = 33

  def of(file: InputFile): Option[PngBands] =
    try
      val start = file.beginning(Beginning)
      val isPng = start.length == Beginning && PngChunks.areIn(start) &&
        number(start, 8) == 13 && String(start, 12, 4, "US-ASCII") == "IHDR"
      val (width, height) = if isPng then (number(start, 16), number(start, 20)) else (0, 0)
      for
        names <- if width > 0 && height > 0 then Names.get(start(25)) else None
        bits = start(24)
        if (bits == 8 || bits == 16) && (start(26) | start(27) | start(28)) == 0
        row = width.toLong * names.size * (bits / 8)
        if row * ImageBands.Rows < Int.MaxValue
        if row * height <= file.size * StbReader.MaxCompression
        if !isKeyed(file)
      yield PngBands(file, width, height, names, bits / 8)
    catch case _: IOException | _: DataFormatException => None

  /** Whether a chunk before the pixels says more than how to show them. */
  private def isKeyed(file: InputFile): Boolean =
    !Using.resource(file.again())(stream => Using.resource(PngData(stream))(_.next()))

  private def number(bytes: Array[Byte], at: Int): Int =
    (0 until 4).foldLeft(0)((n, i) => n << 8 | bytes(at + i) & 0xff)

/** The unpacked bytes of a PNG file's pixels. */
private final class PngData(stream: InputStream) extends AutoCloseable:
  import PngData.*
  private val input = DataInputStream(stream)
  private val inflater = Inflater()
  private val sum = CRC32()
  private val packed = new Array[Byte](1 << 16)
  private val singleByte = new Array[Byte](1)
  private var remainingBytes = 0
  private var isInData = false
  input.skipNBytes(PngBands.Beginning)

  def close(): Unit = inflater.end()

  def byte(): Int =
    read(singleByte)
    singleByte(0) & 0xff

  def read(bytes: Array[Byte]): Unit =
    var offset = 0
    while offset < bytes.length do
      if inflater.finished then throw EOFException()
      offset += unpack(bytes, offset)

  /** Reads on to the end of the file, where faults may be, too. */
  def end(): Unit =
    val discarded = new Array[Byte](1 << 12)
    while !inflater.finished do unpack(discarded, 0): Unit
    while next() do ()

  /** Goes on to the next chunk of pixels, past those that only say how to show them.
    *
    * @return whether there is one before the end of the image
    */
  def next(): Boolean =
    if isInData then endData()
    remainingBytes = input.readInt()
    var kind = input.readInt()
    while PngChunks.isPlain(kind) do
      input.skipNBytes((remainingBytes & 0xffffffffL) + Checksum)
      remainingBytes = input.readInt()
      kind = input.readInt()
    isInData = kind == Data && remainingBytes >= 0
    sum.reset()
    sum.update(DataName)
    if !isInData && kind != PngChunks.End then
      throw DataFormatException("it has a chunk that is damaged, unknown, or in the wrong place")
    isInData

  /** The number of bytes that are there at once, which may be 0. */
  private def unpack(into: Array[Byte], at: Int): Int =
    val count = inflater.inflate(into, at, into.length - at)
    if count == 0 && !inflater.finished then
      if inflater.needsInput then feed() else throw EOFException()
    count

  private def feed(): Unit =
    while remainingBytes == 0 do if !next() then throw EOFException()
    inflater.setInput(packed, 0, readChunk())

  /** Reads on in the chunk; the number of bytes. */
  private def readChunk(): Int =
    val count = input.read(packed, 0, Math.min(remainingBytes, packed.length))
    if count < 0 then throw EOFException()
    remainingBytes -= count
    sum.update(packed, 0, count)
    count

  /** Reads what is left of the chunk, and its checksum. */
  private def endData(): Unit =
    while remainingBytes > 0 do readChunk(): Unit
    if input.readInt() != sum.getValue.toInt then
      throw DataFormatException("it has a chunk IDAT whose checksum is wrong")

private object PngData:
  private val Data = 0x49444154 // IDAT

  private val DataName = "IDAT".getBytes

  /** Bytes of a chunk's checksum. */
  private val Checksum = 4L
