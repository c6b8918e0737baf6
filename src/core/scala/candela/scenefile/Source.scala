package candela.scenefile

import candela.io.{Digesting, ForeignFile, InputFile, IoReason}
import java.io.{ByteArrayInputStream, FilterInputStream, InputStream, IOException}
import java.nio.ByteBuffer
import java.nio.charset.{CharacterCodingException, StandardCharsets}
import java.nio.file.Path
import java.util.zip.GZIPInputStream

import scala.util.Using

/** The bytes of a file, read sequentially through a sliding window, so files may be of any size.
  *
  * @param name name of the file in messages
  * @param room size of the first window, in bytes
  * @param input bytes after the window
  */
final class Source private (val name: String, room: Int, input: Input):
  private var window = new Array[Byte](room)
  private var end = 0
  private var windowOffset = 0L
  private var isDone = false
  fill()

  /** The window: valid from 0 until `limit`. */
  def bytes: Array[Byte] = window
  def limit: Int = end

  /** The kind of a file that is not a scene, recognised by its first bytes. */
  def foreign(file: Path): Option[ForeignFile] =
    ForeignFile.of(file, window.take(Math.min(end, ForeignFile.Head)))

  /** Whether the window reaches the end of the file. */
  def isLast: Boolean = isDone

  /** Offset of the first byte after the byte order mark, if any. */
  val start: Int = if begins(0xef, 0xbb, 0xbf) then 3 else 0

  /** File offset of the byte at `i` of the window. */
  def offset(i: Int): Long = windowOffset + i

  /** Upper bound on the number of bytes after the byte at `i`. */
  def maxAfter(i: Int): Long = if isDone then end - i else end - i + input.maxRemaining

  /** Slides the window to begin at its offset `from`, and reads more bytes. All window offsets
    * decrease by `from`. An IOException has the cause if reading fails.
    */
  def slide(from: Int): Unit =
    if from == 0 && end == window.length then
      if end > Source.MaxTokenBytes then
        throw IOException(s"token longer than ${Source.MaxTokenBytes >> 20} MB")
      window = java.util.Arrays.copyOf(window, 2 * end)
    else System.arraycopy(window, from, window, 0, end - from)
    end -= from
    windowOffset += from
    fill()

  private def fill(): Unit =
    while !isDone && end < window.length do
      val count = input.stream.read(window, end, window.length - end)
      if count < 0 then close() else end += count

  /** Closes the file; the window is then the last. */
  def close(): Unit =
    isDone = true
    input.stream.close()

  /** The same source from its start, if it can be reopened. */
  def again: Option[Source] = input.again().toOption.map(new Source(name, room, _))

  /** The bytes that are left, from the window's start on, if they are few enough for an array. */
  private[scenefile] def remaining(): Option[Array[Byte]] =
    val first = java.util.Arrays.copyOf(window, end)
    if isDone then Some(first)
    else
      val tail = input.stream.readNBytes(Source.MaxWhole - end)
      val isWhole = input.stream.read() < 0
      close()
      Option.when(isWhole)(first ++ tail)

  /** Decodes a range of the window: UTF-8, or Latin-1 if invalid (old exporters). */
  def text(from: Int, until: Int): String =
    try
      val decoder = StandardCharsets.UTF_8.newDecoder
      decoder.decode(ByteBuffer.wrap(window, from, until - from)).toString
    catch
      case _: CharacterCodingException =>
        new String(window, from, until - from, StandardCharsets.ISO_8859_1)

  private def begins(head: Int*): Boolean =
    end >= head.length && head.indices.forall(i => (window(i) & 0xff) == head(i))

object Source:
  /** Maximum compression ratio of deflate (zlib's technical notes: 1032 to 1). */
  val MaxDeflateRatio = 1032L

  def apply(name: String, bytes: Array[Byte]): Source =
    // One byte of room, so that reading finds the end.
    new Source(name, bytes.length + 1, Input.of(bytes))

  /** A source that reads `bytes` through a window of `room` bytes. */
  private[candela] def windowed(name: String, bytes: Array[Byte], room: Int): Source =
    new Source(name, room, Input.of(bytes))

  def fromText(name: String, text: String): Source =
    Source(name, text.getBytes(StandardCharsets.UTF_8))

  /** Opens a file, decompressing gzip; or returns why it can't.
    *
    * @param noted of what the digest is noted
    */
  def read(file: InputFile, noted: Content = Content.Bytes): Either[String, Source] =
    try
      Input.open(file, noted).flatMap: input =>
        val source = new Source(file.toString, input.maxRemaining.min(Window - 1L).toInt + 1, input)
        if source.begins(0xff, 0xfe) || source.begins(0xfe, 0xff) then
          source.close()
          Left("encoded as UTF-16; save it as UTF-8")
        else Right(source)
    catch case e: IOException => Left(IoReason(e))

  /** Opens a file that another one includes. */
  def readNamed(file: InputFile): Either[String, Source] =
    read(file, Content.Tokens).flatMap: source =>
      source.foreign(file.path) match
        case None => Right(source)
        case Some(foreign) =>
          source.close()
          Left(s"it is ${foreign.what}, not a scene")

  /** Fits the L2 cache of current processors. */
  private val Window = 1 << 17

  private val MaxTokenBytes = 1 << 20

  private val MaxWhole = 1 << 30

/** What a digest of a file is of. */
enum Content:
  case Bytes

  /** As [[TokenDigest]] finds them in a scene file. */
  case Tokens

  /** There is none, so that what is not read now need not be. */
  case Nothing

/** Input stream of a [[Source]].
  *
  * @param remaining upper bound on the bytes left to read
  * @param again reopens the same input
  */
private final class Input(
    val stream: InputStream,
    remaining: () => Long,
    val again: () => Either[String, Input]
):
  def maxRemaining: Long = remaining()

private object Input:

  def of(bytes: Array[Byte]): Input =
    val stream = ByteArrayInputStream(bytes)
    Input(stream, () => stream.available, () => Right(of(bytes)))

  /** Opens a file, decompressing gzip; or returns why it can't. */
  def open(file: InputFile, noted: Content): Either[String, Input] =
    try
      if file.isPipe then ofPipe(file) // which can be read only once
      else Right(opened(file, noted))
    catch
      case e: IOException => Left(IoReason(e))

  private def ofPipe(file: InputFile): Either[String, Input] =
    val maxBytes = Math.min(Runtime.getRuntime.maxMemory / 4, MaxPipeBytes).toInt
    Using.resource(file.stream()): in =>
      val bytes = in.readNBytes(maxBytes)
      if bytes.length < maxBytes || in.read() < 0 then Right(of(bytes))
      else Left(s"more than ${maxBytes >> 20} MB come from it; write them to a file")

  private val MaxPipeBytes = 1L << 30

  private def opened(file: InputFile, noted: Content): Input =
    def again() = open(file, noted)
    def digested(in: InputStream) =
      if noted == Content.Tokens && file.isRegular then Digesting(in, TokenDigest(), file.note)
      else in
    val raw = if noted == Content.Bytes then file.stream() else file.undigested()
    try
      val size = file.size
      raw.mark(2)
      val isPacked = raw.read() == 0x1f && raw.read() == 0x8b
      raw.reset()
      if isPacked then
        val unpacked = Unpacked(raw, size, file.unpacks)
        Input(digested(unpacked), () => unpacked.maxRemaining, again)
      else
        val plain = Counted(raw)
        Input(digested(plain), () => size - plain.count, again)
    catch
      case e: IOException =>
        raw.close()
        throw e

/** Counts the bytes read. */
private class Counted(in: InputStream) extends FilterInputStream(in):
  private var total = 0L

  def count: Long = total

  override def read(): Int =
    val byte = in.read()
    if byte >= 0 then total += 1
    byte

  override def read(into: Array[Byte], from: Int, length: Int): Int =
    val n = in.read(into, from, length)
    if n > 0 then total += n
    n

/** Decompressed gzip stream. Refuses small files that expand without bound (zip bombs).
  *
  * @param size compressed size, in bytes
  * @param note receives the number of bytes that have been unpacked
  */
private final class Unpacked private (packed: Counted, size: Long, note: Long => Unit)
    extends Counted(GZIPInputStream(packed, 1 << 16)):

  /** Upper bound on the bytes that follow, from deflate's maximum ratio and the allowed one. */
  def maxRemaining: Long =
    val possible = (size - packed.count + (1 << 16)) * Source.MaxDeflateRatio
    possible.min(Unpacked.UncheckedBytes + size * Unpacked.MaxRatio - count)

  override def read(into: Array[Byte], from: Int, length: Int): Int =
    val n = super.read(into, from, length)
    if n > 0 then note(n)
    if count > Unpacked.UncheckedBytes + packed.count * Unpacked.MaxRatio then
      val times = count / packed.count.max(1)
      throw IOException(s"decompresses to more than $times times its size; it can't be a scene")
    n

private object Unpacked:
  def apply(in: InputStream, size: Long, note: Long => Unit): Unpacked =
    new Unpacked(Counted(in), size, note)

  /** Numeric text compresses 3 to 10 times, that of a regular grid 50 times. */
  private val MaxRatio = 100L

  /** Decompressed size below which any ratio is allowed, in bytes. */
  private val UncheckedBytes = 64L << 20
