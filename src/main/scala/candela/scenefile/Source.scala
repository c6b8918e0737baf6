package candela.scenefile

import java.io.{
  BufferedInputStream,
  ByteArrayInputStream,
  FilterInputStream,
  InputStream,
  IOException
}
import java.nio.ByteBuffer
import java.nio.charset.{CharacterCodingException, StandardCharsets}
import java.nio.file.{Files, NoSuchFileException, Path}
import java.util.zip.GZIPInputStream

/** The bytes of one file, from the front to the end: a window of them is in memory at a time, so
  * that files may be of any size.
  *
  * @param name  how messages call the file
  * @param room  the size of the first window, in bytes
  * @param input what is behind the window
  */
final class Source private (val name: String, room: Int, input: Input):
  private var window = new Array[Byte](room)
  private var end = 0
  private var first = 0L
  private var isDone = false
  fill()

  /** The window: these bytes from 0 until `limit`. */
  def bytes: Array[Byte] = window
  def limit: Int = end

  /** Does nothing follow the window? */
  def isLast: Boolean = isDone

  /** The first byte after the byte order mark, if there is one. */
  val start: Int = if begins(0xef, 0xbb, 0xbf) then 3 else 0

  /** Where in the file the byte at `i` of the window is. */
  def offset(i: Int): Long = first + i

  /** At most so many bytes follow the byte at `i`. */
  def mostAfter(i: Int): Long = if isDone then end - i else end - i + input.mostLeft

  /** Moves the window on, so that it begins at `from` of the old one: more bytes come behind. All
    * places in the window become smaller by `from`. An IOException says why there is no more.
    */
  def slide(from: Int): Unit =
    if from == 0 && end == window.length then
      if end > Source.LongestToken then
        throw IOException(s"here is a word of more than ${Source.LongestToken >> 20} MB")
      window = java.util.Arrays.copyOf(window, 2 * end)
    else System.arraycopy(window, from, window, 0, end - from)
    end -= from
    first += from
    fill()

  private def fill(): Unit =
    while !isDone && end < window.length do
      val count = input.stream.read(window, end, window.length - end)
      if count < 0 then close() else end += count

  /** Gives the file back; nothing follows the window any more. */
  def close(): Unit =
    isDone = true
    input.stream.close()

  /** The same from the start, if it can be had once more. */
  def again: Option[Source] = input.again().toOption.map(new Source(name, room, _))

  /** The text between two places of the window: UTF-8, or Latin-1 where it is no valid UTF-8 (old
    * exporters).
    */
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

  def apply(name: String, bytes: Array[Byte]): Source =
    // one byte more: reading it finds the end
    new Source(name, bytes.length + 1, Input.of(bytes))

  /** Likewise, through a window of `room` bytes. */
  private[candela] def windowed(name: String, bytes: Array[Byte], room: Int): Source =
    new Source(name, room, Input.of(bytes))

  def fromText(name: String, text: String): Source =
    Source(name, text.getBytes(StandardCharsets.UTF_8))

  /** The file's bytes, unpacked if they are gzipped; or why they can't be had. */
  def read(path: Path): Either[String, Source] =
    try
      Input.open(path).flatMap: input =>
        val source = new Source(path.toString, input.mostLeft.min(Window - 1L).toInt + 1, input)
        if source.begins(0xff, 0xfe) || source.begins(0xfe, 0xff) then
          source.close()
          Left("it is UTF-16 text; save it as UTF-8")
        else Right(source)
    catch case e: IOException => Left(Option(e.getMessage).getOrElse(e.toString))

  /** Fits the second-level cache of today's processors. */
  private val Window = 1 << 17

  private val LongestToken = 1 << 20

/** Where the bytes of a [[Source]] come from.
  *
  * @param left  at most so many bytes can be read yet
  * @param again opens the same once more
  */
private final class Input(
    val stream: InputStream,
    left: () => Long,
    val again: () => Either[String, Input]
):
  def mostLeft: Long = left()

private object Input:

  def of(bytes: Array[Byte]): Input =
    val stream = ByteArrayInputStream(bytes)
    Input(stream, () => stream.available, () => Right(of(bytes)))

  /** The file's bytes, unpacked if they are gzipped; or why they can't be had. */
  def open(path: Path): Either[String, Input] =
    try
      if Files.isDirectory(path) then Left("it is a folder")
      else if !Files.isRegularFile(path) && Files.exists(path) then
        Right(of(Files.readAllBytes(path))) // a pipe tells all it knows once only
      else Right(opened(path))
    catch
      case _: NoSuchFileException => Left("there is no such file")
      case e: IOException => Left(Option(e.getMessage).getOrElse(e.toString))

  private def opened(path: Path): Input =
    val size = Files.size(path)
    val raw = BufferedInputStream(Files.newInputStream(path))
    try
      raw.mark(2)
      val isPacked = raw.read() == 0x1f && raw.read() == 0x8b
      raw.reset()
      if isPacked then
        val unpacked = Unpacked(raw, size)
        Input(unpacked, () => unpacked.mostLeft, () => open(path))
      else
        val plain = Counted(raw)
        Input(plain, () => size - plain.count, () => open(path))
    catch
      case e: IOException =>
        raw.close()
        throw e

/** Knows how many bytes were read. */
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

/** What a gzipped file holds. A small file that unpacks without end, as its sender may have meant
  * it to, is refused.
  *
  * @param size of the packed file, in bytes
  */
private final class Unpacked private (packed: Counted, size: Long)
    extends Counted(GZIPInputStream(packed, 1 << 16)):

  /** At most so many bytes follow: as much as deflate can do, and as is allowed. */
  def mostLeft: Long =
    val possible = (size - packed.count + (1 << 16)) * Unpacked.MostDeflated
    possible.min(Unpacked.Free + size * Unpacked.MostAllowed - count)

  override def read(into: Array[Byte], from: Int, length: Int): Int =
    val n = super.read(into, from, length)
    if count > Unpacked.Free + packed.count * Unpacked.MostAllowed then
      val times = count / packed.count.max(1)
      throw IOException(s"it unpacks to more than $times times its size: is it a scene at all?")
    n

private object Unpacked:
  def apply(in: InputStream, size: Long): Unpacked = new Unpacked(Counted(in), size)

  /** Deflate can't do better (zlib's technical notes: 1032 to 1). */
  private val MostDeflated = 1032L

  /** Text of numbers packs 3 to 10 times, that of a regular grid 50 times. */
  private val MostAllowed = 100L

  /** So many bytes are unpacked whatever their ratio. */
  private val Free = 64L << 20
