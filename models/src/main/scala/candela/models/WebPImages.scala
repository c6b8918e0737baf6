package candela.models

import candela.diagnostics.{Code, Limit, SourcePos}
import candela.io.IoReason

import java.awt.image.RenderedImage
import java.io.{ByteArrayInputStream, ByteArrayOutputStream, IOException}
import java.nio.ByteBuffer
import java.nio.charset.StandardCharsets.ISO_8859_1
import javax.imageio.{ImageIO, ImageReader}
import javax.imageio.stream.{MemoryCacheImageInputStream, MemoryCacheImageOutputStream}

/** Images in WebP, as PNG: all else reads that. The reader is one of Java's image readers, without
  * native code.
  */
private[models] object WebPImages:
  private val MaxPixels = 1L << 28

  /** Whether a file begins as WebP does. */
  def contains(bytes: ByteBuffer): Boolean =
    bytes.remaining >= 12 && text(bytes, 0) == "RIFF" && text(bytes, 8) == "WEBP"

  private def text(bytes: ByteBuffer, from: Int): String =
    val letters = new Array[Byte](4)
    bytes.duplicate.position(bytes.position() + from).get(letters): Unit
    String(letters, ISO_8859_1)

  def png(bytes: ByteBuffer, session: Session, at: SourcePos): ByteBuffer =
    val all = new Array[Byte](bytes.remaining)
    bytes.duplicate.get(all): Unit
    val readers = ImageIO.getImageReadersByFormatName("webp")
    if !readers.hasNext then
      Session.fail(at, "this program lacks the reader of WebP images", Code.Unsupported)
    val reader = readers.next()
    try decoded(reader, all, session, at)
    finally reader.dispose()

  private def decoded(
      reader: ImageReader,
      bytes: Array[Byte],
      session: Session,
      at: SourcePos
  ): ByteBuffer =
    def fail(reason: String) =
      Session.fail(at, s"can't read the WebP image: $reason", Code.DamagedImage)
    try
      reader.setInput(MemoryCacheImageInputStream(ByteArrayInputStream(bytes)), true, true)
      val (width, height) = (reader.getWidth(0), reader.getHeight(0))
      val pixels = width.toLong * height
      session.folder.allowance.check(Limit.Pixels, pixels, Some(at))(
        s"an image of $width × $height pixels"
      )
      if pixels > MaxPixels then Session.fail(at, s"$width × $height pixels", Code.TooLarge)
      encoded(reader.read(0))
    catch
      case e: IOException => fail(if e.getMessage == null then "it is damaged" else IoReason(e))
      // Damaged files can lead readers beyond their arrays
      case _: (IndexOutOfBoundsException | IllegalArgumentException | NegativeArraySizeException) =>
        fail("it is damaged")

  /** An image as PNG. */
  def encoded(image: RenderedImage): ByteBuffer =
    val out = ByteArrayOutputStream()
    val writer = ImageIO.getImageWritersByFormatName("png").next()
    val stream = MemoryCacheImageOutputStream(out)
    try
      writer.setOutput(stream)
      writer.write(image)
    finally
      writer.dispose()
      stream.close()
    ByteBuffer.wrap(out.toByteArray)
