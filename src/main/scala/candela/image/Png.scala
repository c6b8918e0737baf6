package candela.image

import candela.base.loop
import candela.color.{Encoding, Srgb}

import java.awt.image.BufferedImage
import java.io.ByteArrayOutputStream
import javax.imageio.metadata.{IIOInvalidTreeException, IIOMetadata, IIOMetadataNode}
import javax.imageio.stream.MemoryCacheImageOutputStream
import javax.imageio.{IIOImage, ImageIO, ImageTypeSpecifier}

/** Writes PNG: 8 bits, sRGB-encoded, values clamped to [0, 1], NaN black. */
private[image] object Png extends OutputFormat("png", Contents.Display):

  // Before the first class of AWT loads: a renderer must not open a display.
  if System.getProperty("java.awt.headless") == null then
    val _ = System.setProperty("java.awt.headless", "true")

  private val NativeFormat = "javax_imageio_png_1.0"

  def write(image: Image, metadata: Vector[(String, String)], isHalf: Boolean): Array[Byte] =
    val isGray = image.indicesOf(Image.RgbNames).isEmpty
    val kind = if isGray then BufferedImage.TYPE_BYTE_GRAY else BufferedImage.TYPE_INT_RGB
    val picture = BufferedImage(image.width, image.height, kind)
    val sources = if isGray then Vector(image.colorChannels.head) else image.colorChannels
    val codes = new Array[Int](sources.size * image.width)
    loop(image.height): y =>
      loop(image.width): x =>
        loop(sources.size): c =>
          codes(x * sources.size + c) = code(image(x, y, sources(c)), image.encoding)
      picture.getRaster.setPixels(0, y, image.width, 1, codes)

    val writer = ImageIO.getImageWritersByFormatName("png").next()
    val bytes = ByteArrayOutputStream()
    try
      val output = MemoryCacheImageOutputStream(bytes)
      val chunks = writer.getDefaultImageMetadata(ImageTypeSpecifier(picture), null)
      describe(chunks, metadata)
      writer.setOutput(output)
      writer.write(IIOImage(picture, null, chunks))
      output.close()
    finally writer.dispose()
    bytes.toByteArray

  private def code(value: Float, encoding: Encoding): Int = encoding match
    case Encoding.Srgb => if value > 0f then (Math.min(value, 1f) * 255f + 0.5f).toInt else 0
    case _ => Srgb.encode8(encoding.decode(value))

  /** Adds the texts as iTXt chunks, and an sRGB chunk. */
  private def describe(chunks: IIOMetadata, texts: Vector[(String, String)]): Unit =
    val root = IIOMetadataNode(NativeFormat)
    if texts.nonEmpty then
      val all = IIOMetadataNode("iTXt")
      for (name, text) <- texts do
        val entry = IIOMetadataNode("iTXtEntry")
        entry.setAttribute("keyword", name)
        entry.setAttribute("compressionFlag", "FALSE")
        entry.setAttribute("compressionMethod", "0")
        entry.setAttribute("languageTag", "")
        entry.setAttribute("translatedKeyword", "")
        entry.setAttribute("text", text)
        val _ = all.appendChild(entry)
      val _ = root.appendChild(all)
    val srgb = IIOMetadataNode("sRGB")
    srgb.setAttribute("renderingIntent", "Relative colorimetric")
    val _ = root.appendChild(srgb)
    try chunks.mergeTree(NativeFormat, root)
    catch
      case e: IIOInvalidTreeException =>
        throw ImageError(s"metadata that PNG can't hold: ${e.getMessage}")
