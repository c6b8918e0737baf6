package candela.image

import candela.diagnostics.Code
import java.nio.ByteBuffer
import java.nio.charset.StandardCharsets.ISO_8859_1
import java.util.zip.CRC32

/** Checks what decoders that care for speed take as it is: the checksums of a PNG's chunks, without
  * which damaged pixels are pixels of other colours.
  *
  * Source: PNG Specification, 3rd ed., §5.3 and §13.2. An error in a chunk that may be left out is
  * none of the image.
  */
private[image] object PngChunks:
  /** The name of a chunk of alpha, or of a colour that is transparent. */
  private val Transparency = 0x74524e53 // tRNS
  val End = 0x49454e44 // IEND
  private val Mark = 0x89504e470d0a1a0aL
  private inline val SignatureBytes = 8

  /** Length and name before the data of a chunk, and the checksum behind it, in bytes. */
  private inline val HeadBytes = 8
  private inline val ChecksumBytes = 4

  /** Whether a file that begins like this is a PNG. */
  def areIn(bytes: Array[Byte]): Boolean =
    bytes.length >= SignatureBytes && ByteBuffer.wrap(bytes).getLong == Mark

  /** Whether the pixels are the same without chunks of this name: its first letter is small then.
    */
  def isPlain(name: Int): Boolean = (name & 0x20000000) != 0 && name != Transparency

  /** @throws ImageError if the data of a chunk are not those that were written */
  def check(bytes: Array[Byte]): Unit =
    if areIn(bytes) then
      val file = ByteBuffer.wrap(bytes)
      var position = SignatureBytes
      // A chunk that is cut short is told by the decoder
      while position >= 0 && file.limit - position >= HeadBytes + ChecksumBytes do
        position = checked(file, position)

  /** Checks the chunk that begins at `at`; where the next one begins, below 0 if there is none. */
  private def checked(file: ByteBuffer, at: Int): Int =
    val length = file.getInt(at)
    val end = at.toLong + HeadBytes + length
    if length < 0 || end + ChecksumBytes > file.limit then -1
    else
      val name = file.getInt(at + 4)
      if !isPlain(name) then
        val sum = CRC32()
        // That of the name, too
        sum.update(file.array, at + 4, length + 4)
        if sum.getValue.toInt != file.getInt(end.toInt) then
          val word = String(file.array, at + 4, 4, ISO_8859_1)
          throw ImageError(
            Code.DamagedImage,
            s"the checksum of the chunk $word at byte $at is wrong: the file is damaged"
          )
      if name == End then -1 else end.toInt + ChecksumBytes
