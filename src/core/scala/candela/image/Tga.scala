package candela.image

import candela.diagnostics.Code
import java.nio.{ByteBuffer, ByteOrder}

/** Reads TGA, and writes it, since films of pbrt-v2 and v3 may name it: 24 bits, or 32 with alpha,
  * uncompressed,
  * sRGB-encoded, values clamped to [0, 1], NaN black.
  *
  * Source: Truevision TGA File Format Specification, version 2.0, 1991.
  */
private[image] object Tga extends OutputFormat("tga", Contents.Display):
  private val HeaderSize = 18
  private val TrueColor = 2
  private val TopLeft = 0x20
  private val FromRight = 0x10

  /** By stb_image, which knows neither columns from the right nor palettes that don't begin with
    * entry 0.
    */
  def read(file: Array[Byte], admit: (Int, Int) => Unit = (_, _) => ()): StoredImage =
    val image = StbReader.read(withWholePalette(file), admit)
    if !isFromRight(file) then image
    else
      val n = image.channels
      val source = (0 until image.width * image.height * n).map: i =>
        val x = i / n % image.width
        i + (image.width - 1 - 2 * x) * n
      image match
        case bytes: ByteImage =>
          val turned = source.map(bytes.bytes(_)).toArray
          ByteImage(image.width, image.height, image.channelNames, turned, bytes.encoding)
        case floats: Image =>
          val turned = source.map(floats.data(_)).toArray
          Image(image.width, image.height, image.channelNames, turned, floats.encoding)

  /** How pbrt-v4 reads the file differently, if it does. */
  def remark(file: Array[Byte]): Option[String] =
    if file.length < HeaderSize then None
    else if isFromRight(file) then Some("its columns run from the right; pbrt-v4 mirrors it")
    else if firstEntry(file) > 0 then
      Some(s"its palette begins with entry ${firstEntry(file)}; pbrt-v4 takes it for entry 0")
    else None

  private def isFromRight(file: Array[Byte]) =
    file.length >= HeaderSize && (file(17) & FromRight) != 0

  private def short(file: Array[Byte], at: Int) = file(at) & 0xff | (file(at + 1) & 0xff) << 8

  /** Number of the palette's first entry; 0 without a palette. */
  private def firstEntry(file: Array[Byte]): Int =
    if file.length < HeaderSize || file(1) != 1 then 0 else short(file, 3)

  /** The file with a palette from entry 0. */
  private def withWholePalette(file: Array[Byte]): Array[Byte] =
    val firstIndex = firstEntry(file)
    def count = firstIndex + short(file, 5)
    if firstIndex == 0 || count > 0xffff then file
    else
      val start = HeaderSize + (file(0) & 0xff)
      val unused = new Array[Byte](firstIndex * (((file(7) & 0xff) + 7) / 8))
      val completed = file.take(start) ++ unused ++ file.drop(start)
      completed(3) = 0
      completed(4) = 0
      completed(5) = count.toByte
      completed(6) = (count >> 8).toByte
      completed

  override def keepsAlpha: Boolean = true

  private[image] override def hasEnd(file: Array[Byte]): Boolean =
    val header = ByteBuffer.wrap(file).order(ByteOrder.LITTLE_ENDIAN)
    def size(at: Int) = header.getShort(at) & 0xffff
    // Others compress
    file(2) != TrueColor || file.length == HeaderSize + size(12) * size(14) * (file(16) / 8)

  def write(image: Image, metadata: Vector[(String, String)], options: WriteOptions): Array[Byte] =
    val picture = Bitmap.of(image, options.display.copy(bits = 8), options.alpha)
    val (width, height) = (picture.getWidth, picture.getHeight)
    if width > 0xffff || height > 0xffff then
      throw ImageError(Code.TooLarge, s"TGA holds at most 65535×65535 pixels, found $width×$height")
    val alphaBits = if options.alpha.isDefined then 8 else 0
    val depth = 24 + alphaBits
    val file = ByteBuffer.allocate(HeaderSize + depth / 8 * width * height)
      .order(ByteOrder.LITTLE_ENDIAN)
    file.put(2, TrueColor.toByte).putShort(12, width.toShort).putShort(14, height.toShort)
    file.put(16, depth.toByte).put(17, (TopLeft | alphaBits).toByte).position(HeaderSize)
    val bands = picture.getRaster.getNumBands
    val order = if bands == 4 then Array(2, 1, 0, 3) else Array(bands - 1, bands / 2, 0)
    val row = new Array[Int](width * bands)
    for y <- 0 until height do
      val _ = picture.getRaster.getPixels(0, y, width, 1, row)
      for x <- 0 until width; band <- order do
        val _ = file.put(row(x * bands + band).toByte)
    file.array
