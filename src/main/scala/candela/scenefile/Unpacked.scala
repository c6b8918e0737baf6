package candela.scenefile

import java.io.{FilterInputStream, IOException, InputStream}
import java.util.zip.GZIPInputStream

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
