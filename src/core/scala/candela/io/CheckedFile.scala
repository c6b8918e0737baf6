package candela.io

import candela.concurrency.DirectBuffers
import java.io.{EOFException, IOException}
import java.nio.ByteBuffer
import java.nio.ByteOrder.LITTLE_ENDIAN
import java.nio.channels.FileChannel
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Path, StandardOpenOption}
import java.util.zip.CRC32C

import scala.util.Using
import scala.util.control.NonFatal

/** A file of numbers and texts that ends with its length and checksum, so that a damaged file is
  * recognised before any of it is used.
  */
object CheckedFile:

  def write(path: Path, mark: String)(body: CheckedOutput => Unit): Unit =
    WholeFile.write(path)(writeTo(_, mark)(body))

  /** Writes the whole file to an empty one. */
  def writeTo(channel: FileChannel, mark: String)(body: CheckedOutput => Unit): Unit =
    Buffers.lend: buffer =>
      val output = CheckedOutput(channel, buffer)
      output.text(mark)
      body(output)
      output.end()

  /** Verifies the file, then reads it from its start.
    *
    * @param mark what the file must begin with, as given to `write`
    * @throws IOException if it can't be read, is damaged, or of another kind
    */
  def read[A](path: Path, mark: String)(body: CheckedInput => A): A =
    open(FileChannel.open(path, StandardOpenOption.READ), mark): (channel, in) =>
      verify(channel)
      body(in)

  /** As `read`, of a body that makes something and does nothing else: the file is verified while it
    * is read, and what is made of a damaged one is dropped.
    */
  def readOnce[A](path: Path, mark: String)(body: CheckedInput => A): A =
    readOnce(FileChannel.open(path, StandardOpenOption.READ), mark)(body)

  /** As `readOnce`, of an open file, which is closed. */
  def readOnce[A](file: => FileChannel, mark: String)(body: CheckedInput => A): A =
    open(file, mark): (channel, in) =>
      val result =
        try body(in)
        catch
          case NonFatal(e) =>
            verify(channel)
            throw e
      in.verify()
      result

  private def open[A](file: => FileChannel, mark: String)(
      body: (FileChannel, CheckedInput) => A
  ): A =
    Using.resource(file): channel =>
      Buffers.lend: buffer =>
        val input = CheckedInput(channel, buffer)
        val isMarked =
          try input.text() == mark
          catch case _: EOFException => false
        if !isMarked then throw IOException("its first bytes are wrong")
        body(channel, input)

  private def verify(channel: FileChannel): Unit = Buffers.lend: buffer =>
    val end = channel.size - Trailer
    val sum = CRC32C()
    var position = 0L
    while position < end do
      buffer.clear().limit(Math.min(buffer.capacity.toLong, end - position).toInt)
      if channel.read(buffer, position) < 0 then throw EOFException()
      position += buffer.position()
      sum.update(buffer.flip())
    compare(channel, end, sum)

  /** Compares length and checksum with those at the end of the file. */
  private[candela] def compare(channel: FileChannel, end: Long, sum: CRC32C): Unit =
    val buffer = ByteBuffer.allocate(Trailer).order(LITTLE_ENDIAN)
    while buffer.hasRemaining && channel.read(buffer, end + buffer.position()) >= 0 do ()
    buffer.flip()
    if buffer.limit() < Trailer || buffer.getLong() != end || buffer.getLong() != sum.getValue then
      throw IOException("it is damaged: its checksum is wrong")

  /** Moves numbers of four bytes, as many at once as the buffer has room for or holds.
    *
    * @param ready the buffer, once there is at least one number's room or one number
    * @param move  those from a number on, so many
    */
  private[candela] def transfer(count: Int, ready: => ByteBuffer)(
      move: (ByteBuffer, Int, Int) => Any
  ): Unit =
    var i = 0
    while i < count do
      val buffer = ready
      val batch = Math.min(count - i, buffer.remaining / 4)
      move(buffer, i, batch): Unit
      buffer.position(buffer.position() + 4 * batch)
      i += batch

  private val Buffers = DirectBuffers(1 << 16)

  /** Bytes of length and checksum. */
  private[candela] val Trailer = 16

/** Writes values to a [[CheckedFile]], in little-endian order. */
final class CheckedOutput private[candela] (channel: FileChannel, buffer: ByteBuffer):
  private val sum = CRC32C()
  private var length = 0L

  def int(value: Int): Unit = room(4).putInt(value): Unit
  def long(value: Long): Unit = room(8).putLong(value): Unit
  def float(value: Float): Unit = room(4).putFloat(value): Unit
  def double(value: Double): Unit = room(8).putDouble(value): Unit

  def text(value: String): Unit =
    val bytes = value.getBytes(UTF_8)
    int(bytes.length)
    for b <- bytes do room(1).put(b): Unit

  /** The count, and all. */
  def floats(values: Array[Float]): Unit =
    int(values.length)
    CheckedFile.transfer(values.length, room(4))(_.asFloatBuffer.put(values, _, _))

  /** Likewise. */
  def ints(values: Array[Int]): Unit =
    int(values.length)
    CheckedFile.transfer(values.length, room(4))(_.asIntBuffer.put(values, _, _))

  private def room(bytes: Int): ByteBuffer =
    if buffer.remaining < bytes then flush()
    buffer

  private def flush(): Unit =
    buffer.flip()
    sum.update(buffer.duplicate())
    length += buffer.remaining
    while buffer.hasRemaining do channel.write(buffer): Unit
    buffer.clear(): Unit

  private[candela] def end(): Unit =
    flush()
    buffer.putLong(length).putLong(sum.getValue).flip()
    while buffer.hasRemaining do channel.write(buffer): Unit

/** Reads the values of a [[CheckedFile]], in the order in which they were written. */
final class CheckedInput private[candela] (channel: FileChannel, buffer: ByteBuffer):
  buffer.flip() // nothing is read yet
  private val end = channel.size - CheckedFile.Trailer
  private var unread = end
  private val sum = CRC32C()

  def int(): Int = fetch(4).getInt
  def long(): Long = fetch(8).getLong
  def float(): Float = fetch(4).getFloat
  def double(): Double = fetch(8).getDouble

  /** The number of values that follow.
    *
    * @param bytes of each, at least
    * @throws EOFException if the file has fewer
    */
  def count(bytes: Int): Int =
    val count = int()
    if count < 0 || count.toLong * bytes > unread + buffer.remaining then throw EOFException()
    count

  /** Numbers that were written together. */
  def floats(): Array[Float] =
    val values = new Array[Float](count(bytes = 4))
    CheckedFile.transfer(values.length, fetch(4))(_.asFloatBuffer.get(values, _, _))
    values

  /** Likewise. */
  def ints(): Array[Int] =
    val values = new Array[Int](count(bytes = 4))
    CheckedFile.transfer(values.length, fetch(4))(_.asIntBuffer.get(values, _, _))
    values

  def isAtEnd: Boolean = unread <= 0 && !buffer.hasRemaining

  def text(): String =
    val length = count(bytes = 1)
    val bytes = new Array[Byte](length)
    for i <- bytes.indices do bytes(i) = fetch(1).get
    String(bytes, UTF_8)

  /** The buffer, which has so many bytes. */
  private def fetch(bytes: Int): ByteBuffer =
    if buffer.remaining < bytes then
      buffer.compact().limit(Math.min(
        buffer.capacity.toLong,
        buffer.position() + Math.max(0L, unread)
      ).toInt)
      val start = buffer.position()
      while buffer.hasRemaining && channel.read(buffer) >= 0 do ()
      unread -= buffer.position() - start
      sum.update(buffer.duplicate().flip().position(start))
      buffer.flip()
      if buffer.remaining < bytes then throw EOFException()
    buffer

  /** Reads what is left.
    *
    * @throws IOException if the file is damaged
    */
  private[candela] def verify(): Unit =
    while unread > 0 do
      val previous = unread
      buffer.position(buffer.limit())
      fetch(1): Unit
      if unread == previous then throw EOFException()
    CheckedFile.compare(channel, end, sum)
