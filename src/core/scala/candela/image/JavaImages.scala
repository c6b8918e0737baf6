package candela.image

import java.awt.image.BufferedImage
import java.io.ByteArrayOutputStream
import javax.imageio.metadata.IIOMetadata
import javax.imageio.stream.MemoryCacheImageOutputStream
import javax.imageio.{IIOImage, ImageIO, ImageTypeSpecifier, ImageWriteParam, ImageWriter}

/** The JDK's image encoders. */
private[image] object JavaImages:

  /** @param describe adds metadata
    * @param quality  in [0, 1], of lossy formats
    */
  def encode(format: String, picture: BufferedImage, quality: Option[Float] = None)(
      describe: IIOMetadata => Unit
  ): Array[Byte] =
    val writer = ImageIO.getImageWritersByFormatName(format).next()
    val bytes = ByteArrayOutputStream()
    try
      val output = MemoryCacheImageOutputStream(bytes)
      val settings = quality.map(lossy(writer, _)).orNull
      val metadata = writer.getDefaultImageMetadata(ImageTypeSpecifier(picture), settings)
      describe(metadata)
      writer.setOutput(output)
      writer.write(null, IIOImage(picture, null, metadata), settings)
      output.close()
    finally writer.dispose()
    bytes.toByteArray

  private def lossy(writer: ImageWriter, quality: Float): ImageWriteParam =
    val settings = writer.getDefaultWriteParam
    settings.setCompressionMode(ImageWriteParam.MODE_EXPLICIT)
    settings.setCompressionQuality(quality)
    settings
