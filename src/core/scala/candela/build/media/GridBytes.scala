package candela.build.media

import java.nio.channels.FileChannel
import java.nio.{ByteBuffer, ByteOrder}
import java.util.zip.{DataFormatException, Inflater}

import scala.collection.mutable

/** Bytes with random access, perhaps more than an array can hold. */
private[media] abstract class GridBytes(val size: Long):

  protected def fill(at: Long, target: ByteBuffer): Unit

  /** `count` bytes, little-endian.
    *
    * @throws NanoVdbError if there are fewer
    */
  final def read(place: Long, count: Int): ByteBuffer =
    if place < 0 || place > size - count then
      throw NanoVdbError(s"the file is damaged or cut short: $count bytes at $place of $size")
    val target = ByteBuffer.allocate(count).order(ByteOrder.LITTLE_ENDIAN)
    fill(place, target)
    target.flip()

  final def slice(start: Long, length: Long): GridBytes =
    if start < 0 || length < 0 || start > size - length then
      throw NanoVdbError(s"the file is cut short: $length bytes at $start of $size")
    val outer = this
    new GridBytes(length):
      protected def fill(at: Long, target: ByteBuffer): Unit = outer.fill(start + at, target)

private[media] final class FileBytes(channel: FileChannel, start: Long, length: Long)
    extends GridBytes(length):
  protected def fill(at: Long, target: ByteBuffer): Unit =
    while target.hasRemaining do
      if channel.read(target, start + at + target.position) < 0 then
        throw NanoVdbError("the file is cut short")

/** Pages in memory. */
private[media] final class InflatedBytes(pages: Vector[Array[Byte]], length: Long)
    extends GridBytes(length):
  protected def fill(at: Long, target: ByteBuffer): Unit =
    var position = at
    while target.hasRemaining do
      val page = pages((position / InflatedBytes.PageSize).toInt)
      val offset = (position % InflatedBytes.PageSize).toInt
      val count = Math.min(page.length - offset, target.remaining)
      val _ = target.put(page, offset, count)
      position += count

private[media] object InflatedBytes:
  private val PageSize = 1 << 20
  private val ReadSize = 1 << 16

  /** Decompresses `size` bytes: 8 bytes have the length of the zlib stream that follows. */
  def of(file: GridBytes, start: Long, stored: Long, size: Long): InflatedBytes =
    val length = file.read(start, 8).getLong()
    if length > stored - 8 then throw NanoVdbError("the length of a ZIP stream is damaged")
    val source = file.slice(start + 8, length)
    val inflater = Inflater()
    try
      val pages = mutable.ArrayBuffer.empty[Array[Byte]]
      var read = 0L
      var remaining = size
      // Pages are allocated as they fill: a damaged size requests no memory.
      while remaining > 0 do
        val page = new Array[Byte](Math.min(remaining, PageSize).toInt)
        var filled = 0
        while filled < page.length do
          if inflater.needsInput then
            val count = Math.min(length - read, ReadSize).toInt
            if count == 0 || inflater.finished then throw NanoVdbError("a ZIP stream is cut short")
            inflater.setInput(source.read(read, count))
            read += count
          if inflater.finished then throw NanoVdbError("a ZIP stream is cut short")
          filled += inflater.inflate(page, filled, page.length - filled)
        pages += page
        remaining -= page.length
      InflatedBytes(pages.toVector, size)
    catch
      case e: DataFormatException => throw NanoVdbError(s"a ZIP stream is damaged: ${e.getMessage}")
    finally inflater.end()
