package candela.image

import javax.imageio.metadata.{IIOMetadata, IIOMetadataNode}

/** Writes JPEG: 8 bits, sRGB-encoded, values clamped to [0, 1], NaN black; lossy. */
private[image] object Jpeg extends OutputFormat("jpg", Contents.Display):
  private val NativeFormat = "javax_imageio_jpeg_image_1.0"

  /** Differences from the original can hardly be seen. */
  private val Quality = 0.95f

  override def keepsTexts: Boolean = true

  private[image] override def hasEnd(file: Array[Byte]): Boolean =
    file.takeRight(2).sameElements(Array(0xff.toByte, 0xd9.toByte))

  override def aliases: Vector[String] = Vector("jpeg")

  def write(image: Image, metadata: Vector[(String, String)], options: WriteOptions): Array[Byte] =
    val picture = Bitmap.of(image, options.display.copy(bits = 8))
    JavaImages.encode("jpeg", picture, quality = Some(Quality))(describe(_, metadata))

  /** Adds a comment of one line per text. */
  private def describe(file: IIOMetadata, texts: Vector[(String, String)]): Unit =
    if texts.nonEmpty then
      val text = texts.map((name, value) => s"$name: $value").mkString("\n")
      val comment = IIOMetadataNode("com")
      comment.setUserObject(text.getBytes("UTF-8").take(65533))
      val markers = IIOMetadataNode("markerSequence")
      val _ = markers.appendChild(comment)
      val root = IIOMetadataNode(NativeFormat)
      val _ = root.appendChild(IIOMetadataNode("JPEGvariety"))
      val _ = root.appendChild(markers)
      file.mergeTree(NativeFormat, root)
