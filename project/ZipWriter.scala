package packaging

import java.io.{BufferedOutputStream, ByteArrayOutputStream, OutputStream}
import java.nio.charset.StandardCharsets.UTF_8
import java.nio.file.{Files, Path}
import java.security.MessageDigest
import java.util.zip.{CRC32, Deflater, DeflaterOutputStream}

/** The bytes of a file, read and compressed once, though several packages have them. */
final class Content(read: => Array[Byte]) {
  lazy val bytes: Array[Byte] = read

  lazy val crc: Long = {
    val sum = new CRC32
    sum.update(bytes)
    sum.getValue
  }

  lazy val packed: Array[Byte] = {
    val deflater = new Deflater(Deflater.BEST_COMPRESSION, true)
    val out = new ByteArrayOutputStream
    val stream = new DeflaterOutputStream(out, deflater)
    try stream.write(bytes)
    finally {
      stream.close()
      deflater.end()
    }
    out.toByteArray
  }
}

/** A file of a package.
  *
  * @param name         with `/` between folders
  * @param isExecutable on systems that ask
  */
final case class Entry(name: String, isExecutable: Boolean, content: Content) {

  /** The same file in a folder. */
  def in(folder: String): Entry = copy(name = s"$folder/$name")
}

object Entry {
  def text(name: String, text: String, isExecutable: Boolean = false): Entry =
    Entry(name, isExecutable, new Content(text.getBytes(UTF_8)))

  def file(name: String, path: Path, isExecutable: Boolean = false): Entry =
    Entry(name, isExecutable, new Content(Files.readAllBytes(path)))
}

/** Zip files that are the same bytes for the same entries: sorted, of one time, with Unix's
  * permissions, which Java's own writer does not store.
  *
  * Source: PKWARE, ".ZIP File Format Specification", APPNOTE 6.3, without zip64.
  */
object ZipWriter {
  private val Made = (3 << 8) | 20 // by Unix; version 2.0
  private val Needed = 20
  private val Utf8 = 1 << 11
  private val Deflated = 8
  private val Time = 0
  private val Date = (1 << 5) | 1 // 1980-01-01, the first of the format

  def write(entries: Seq[Entry], to: Path): Unit = {
    val sorted = entries.sortBy(_.name)
    val twice = sorted.zip(sorted.drop(1)).collect { case (a, b) if a.name == b.name => a.name }
    require(twice.isEmpty, s"entries of one name: ${twice.mkString(", ")}")
    require(sorted.size < 0xffff, "too many files for a zip file")
    Files.createDirectories(to.toAbsolutePath.getParent)
    val out = new Counted(new BufferedOutputStream(Files.newOutputStream(to)))
    try {
      val places = sorted.map { entry =>
        val at = out.count
        out.int(0x04034b50)
        out.short(Needed)
        common(entry, out)
        out.write(entry.name.getBytes(UTF_8))
        out.write(entry.content.packed)
        at
      }
      val start = out.count
      for ((entry, at) <- sorted.zip(places)) {
        out.int(0x02014b50)
        out.short(Made)
        out.short(Needed)
        common(entry, out)
        Seq(0, 0, 0).foreach(out.short) // comment, disk, kind of file
        val mode = if (entry.isExecutable) 0x81ed else 0x81a4 // regular file; 755 or 644
        out.int(mode.toLong << 16)
        out.int(at)
        out.write(entry.name.getBytes(UTF_8))
      }
      val end = out.count
      require(end < 0xffffffffL, "a zip file of 4 GB")
      out.int(0x06054b50)
      Seq(0, 0, sorted.size, sorted.size).foreach(out.short)
      out.int(end - start)
      out.int(start)
      out.short(0)
    } finally out.close()
  }

  /** What both headers of an entry say. */
  private def common(entry: Entry, out: Counted): Unit = {
    Seq(Utf8, Deflated, Time, Date).foreach(out.short)
    out.int(entry.content.crc)
    out.int(entry.content.packed.length.toLong)
    out.int(entry.content.bytes.length.toLong)
    out.short(entry.name.getBytes(UTF_8).length)
    out.short(0)
  }

  def sha256(file: Path): String = hex(digest(Files.readAllBytes(file)))

  def digest(bytes: Array[Byte]): Array[Byte] = MessageDigest.getInstance("SHA-256").digest(bytes)

  def hex(bytes: Array[Byte]): String = bytes.map("%02x".format(_)).mkString

  /** Little-endian numbers, and how many bytes there are. */
  private final class Counted(out: OutputStream) {
    var count = 0L

    def write(bytes: Array[Byte]): Unit = {
      out.write(bytes)
      count += bytes.length
    }
    def short(n: Int): Unit = write(Array(n.toByte, (n >> 8).toByte))
    def int(n: Long): Unit = {
      short((n & 0xffff).toInt)
      short(((n >> 16) & 0xffff).toInt)
    }
    def close(): Unit = out.close()
  }
}
