package candela.image

import candela.base.Code

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
  /** Decoders make alpha of it. */
  private val Transparency = "tRNS"
  private val Mark = 0x89504e470d0a1a0aL
  private inline val Begin = 8

  /** Length and name before the data of a chunk, and the checksum behind it, in bytes. */
  private inline val Before = 8
  private inline val Behind = 4

  /** @throws ImageError if the data of a chunk are not those that were written */
  def check(bytes: Array[Byte]): Unit =
    val file = ByteBuffer.wrap(bytes)
    if file.remaining >= Begin && file.getLong(0) == Mark then
      var at = Begin
      // A chunk that is cut short is told by the decoder
      while at >= 0 && file.limit - at >= Before + Behind do at = checked(file, at)

  /** Checks the chunk that begins at `at`; where the next one begins, below 0 if there is none. */
  private def checked(file: ByteBuffer, at: Int): Int =
    val length = file.getInt(at)
    val end = at.toLong + Before + length
    if length < 0 || end + Behind > file.limit then -1
    else
      val name = String(file.array, at + 4, 4, ISO_8859_1)
      if name.head.isUpper || name == Transparency then
        val sum = CRC32()
        // That of the name, too
        sum.update(file.array, at + 4, length + 4)
        if sum.getValue.toInt != file.getInt(end.toInt) then
          throw ImageError(
            Code.DamagedImage,
            s"the checksum of the chunk $name at byte $at is wrong: the file is damaged"
          )
      if name == "IEND" then -1 else end.toInt + Behind
