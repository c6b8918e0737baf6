package candela.image

import java.nio.{ByteBuffer, ByteOrder}

/** Writes TGA, which films of pbrt-v2 and v3 may name: 24 bits, uncompressed, sRGB-encoded, values
  * clamped to [0, 1], NaN black.
  *
  * Source: Truevision TGA File Format Specification, version 2.0, 1991.
  */
private[image] object Tga extends OutputFormat("tga", Contents.Display):
  private val HeaderSize = 18
  private val TrueColor = 2
  private val TopLeft = 0x20

  private[image] override def hasEnd(file: Array[Byte]): Boolean =
    val header = ByteBuffer.wrap(file).order(ByteOrder.LITTLE_ENDIAN)
    def size(at: Int) = header.getShort(at) & 0xffff
    // Others compress
    file(2) != TrueColor || file.length >= HeaderSize + size(12) * size(14) * (file(16) / 8)

  def write(image: Image, metadata: Vector[(String, String)], options: WriteOptions): Array[Byte] =
    val picture = Bitmap.of(image, options.display.copy(bits = 8))
    val (width, height) = (picture.getWidth, picture.getHeight)
    if width > 0xffff || height > 0xffff then
      throw ImageError(s"TGA holds at most 65535×65535 pixels, found $width×$height")
    val file = ByteBuffer.allocate(HeaderSize + 3 * width * height).order(ByteOrder.LITTLE_ENDIAN)
    file.put(2, TrueColor.toByte).putShort(12, width.toShort).putShort(14, height.toShort)
    file.put(16, 24.toByte).put(17, TopLeft.toByte).position(HeaderSize)
    val bands = picture.getRaster.getNumBands
    val row = new Array[Int](width * bands)
    for y <- 0 until height do
      val _ = picture.getRaster.getPixels(0, y, width, 1, row)
      for x <- 0 until width; band <- Array(bands - 1, bands / 2, 0) do
        val _ = file.put(row(x * bands + band).toByte)
    file.array
