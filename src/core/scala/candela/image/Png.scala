package candela.image

import candela.diagnostics.Code
import java.nio.charset.StandardCharsets.US_ASCII
import javax.imageio.metadata.{IIOInvalidTreeException, IIOMetadata, IIOMetadataNode}

/** Writes PNG: 8 or 16 bits, sRGB-encoded, values clamped to [0, 1], NaN black; with alpha that is
  * not multiplied into the colours, if there is any.
  */
private[image] object Png extends OutputFormat("png", Contents.Display):
  private val NativeFormat = "javax_imageio_png_1.0"

  override def keepsTexts: Boolean = true
  override def keepsAlpha: Boolean = true

  private[image] override def hasEnd(file: Array[Byte]): Boolean =
    String(file.takeRight(8).take(4), US_ASCII) == "IEND"

  def write(image: Image, metadata: Vector[(String, String)], options: WriteOptions): Array[Byte] =
    val picture = Bitmap.of(image, options.display, options.alpha)
    JavaImages.encode("png", picture)(describe(_, metadata))

  /** Adds the texts as iTXt chunks, and an sRGB chunk. */
  private def describe(chunks: IIOMetadata, texts: Vector[(String, String)]): Unit =
    val root = IIOMetadataNode(NativeFormat)
    if texts.nonEmpty then
      val textChunk = IIOMetadataNode("iTXt")
      for (name, text) <- texts do
        val entry = IIOMetadataNode("iTXtEntry")
        entry.setAttribute("keyword", name)
        entry.setAttribute("compressionFlag", "FALSE")
        entry.setAttribute("compressionMethod", "0")
        entry.setAttribute("languageTag", "")
        entry.setAttribute("translatedKeyword", "")
        entry.setAttribute("text", text)
        val _ = textChunk.appendChild(entry)
      val _ = root.appendChild(textChunk)
    val srgb = IIOMetadataNode("sRGB")
    srgb.setAttribute("renderingIntent", "Relative colorimetric")
    val _ = root.appendChild(srgb)
    try chunks.mergeTree(NativeFormat, root)
    catch
      case e: IIOInvalidTreeException =>
        throw ImageError(Code.UnsupportedImage, s"metadata that PNG can't hold: ${e.getMessage}")
