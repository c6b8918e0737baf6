package candela.scenefile

import java.io.{ByteArrayInputStream, IOException}
import java.nio.ByteBuffer
import java.nio.charset.{CharacterCodingException, StandardCharsets}
import java.nio.file.{Files, NoSuchFileException, Path}
import java.util.zip.GZIPInputStream

/** The bytes of one scene file.
  *
  * @param name how messages call the file
  */
final class Source(val name: String, val bytes: Array[Byte]):

  /** The first byte after the byte order mark, if there is one. */
  val start: Int = if Source.startsWith(bytes, 0xef, 0xbb, 0xbf) then 3 else 0

  /** The text between two offsets: UTF-8, or Latin-1 where it is no valid UTF-8 (old exporters). */
  def text(from: Int, until: Int): String =
    try
      val decoder = StandardCharsets.UTF_8.newDecoder
      decoder.decode(ByteBuffer.wrap(bytes, from, until - from)).toString
    catch
      case _: CharacterCodingException =>
        new String(bytes, from, until - from, StandardCharsets.ISO_8859_1)

object Source:

  def fromText(name: String, text: String): Source =
    Source(name, text.getBytes(StandardCharsets.UTF_8))

  /** The file's bytes, unpacked if they are gzipped; or why they can't be had. */
  def read(path: Path): Either[String, Source] =
    try
      if Files.isDirectory(path) then Left("it is a folder")
      else if Files.exists(path) && Files.size(path) > MaxSize then
        Left("it is larger than 2 GB; split it with Include")
      else
        val raw = Files.readAllBytes(path)
        val bytes =
          if startsWith(raw, 0x1f, 0x8b) then
            GZIPInputStream(ByteArrayInputStream(raw), 1 << 16).readAllBytes()
          else raw
        if startsWith(bytes, 0xff, 0xfe) || startsWith(bytes, 0xfe, 0xff) then
          Left("it is UTF-16 text; save it as UTF-8")
        else Right(Source(path.toString, bytes))
    catch
      case _: NoSuchFileException => Left("there is no such file")
      case e: IOException => Left(Option(e.getMessage).getOrElse(e.toString))

  private val MaxSize = Int.MaxValue - 64L

  private def startsWith(bytes: Array[Byte], head: Int*): Boolean =
    bytes.length >= head.length && head.indices.forall(i => (bytes(i) & 0xff) == head(i))
