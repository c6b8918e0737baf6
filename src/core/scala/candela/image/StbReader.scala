package candela.image

import candela.base.loop
import candela.diagnostics.Code
import candela.color.Encoding

import org.lwjgl.stb.STBImage
import org.lwjgl.system.{MemoryStack, MemoryUtil}

import java.nio.{ByteBuffer, IntBuffer}

/** Reads PNG (8 and 16 bits), JPEG, TGA, BMP, GIF (its first image), and PSD through stb_image;
  * palettes are expanded.
  */
private[image] object StbReader:

  /** Channels by their number, less one. */
  val Names: Vector[Vector[String]] =
    Vector(Vector("Y"), Vector("Y", "A"), Image.RgbNames, Image.RgbNames :+ "A")

  /** @param admit receives width and height before the pixels are decoded */
  def read(file: Array[Byte], admit: (Int, Int) => Unit = (_, _) => ()): StoredImage =
    Natives.require("stb")
    PngChunks.check(file)
    val stack = MemoryStack.stackPush()
    val native = MemoryUtil.memAlloc(file.length)
    try
      native.put(file).flip()
      decode(native, stack.mallocInt(1), stack.mallocInt(1), stack.mallocInt(1), admit)
    finally
      MemoryUtil.memFree(native)
      stack.close()

  private def decode(
      file: ByteBuffer,
      w: IntBuffer,
      h: IntBuffer,
      c: IntBuffer,
      admit: (Int, Int) => Unit
  ): StoredImage =
    if !STBImage.stbi_info_from_memory(file, w, h, c) then failed()
    // That of a BMP is negative if its rows go from top to bottom
    val height = Math.abs(h.get(0))
    admit(w.get(0), height)
    val values = w.get(0).toLong * height * c.get(0)
    if values <= 0 || values > Int.MaxValue - 8 then
      throw ImageError(Code.TooLarge, s"${w.get(0)}×$height pixels are more than fit into memory")
    if stored(file, w.get(0), height, values) > file.remaining.toLong * MaxCompression then
      val bytes = file.remaining
      throw ImageError(
        Code.DamagedImage,
        s"${w.get(0)}×$height pixels can't be in a file of $bytes bytes"
      )
    if STBImage.stbi_is_16_bit_from_memory(file) then
      val pixels = STBImage.stbi_load_16_from_memory(file, w, h, c, 0)
      if pixels == null then failed()
      try
        val data = new Array[Float](pixels.remaining)
        loop(data.length)(i => data(i) = (pixels.get(i) & 0xffff) / 65535f)
        Image(w.get(0), h.get(0), Names(c.get(0) - 1), data, Encoding.Srgb)
      finally STBImage.stbi_image_free(pixels)
    else
      val pixels = STBImage.stbi_load_from_memory(file, w, h, c, 0)
      if pixels == null then failed()
      try
        val bytes = new Array[Byte](pixels.remaining)
        // Absolute: a relative get would move the position, and the wrong address would be freed.
        val _ = pixels.get(0, bytes)
        ByteImage(w.get(0), h.get(0), Names(c.get(0) - 1), bytes, Encoding.Srgb)
      finally STBImage.stbi_image_free(pixels)

  /** Uncompressed size of the pixels: a PNG may have 1, 2 or 4 bits per value. */
  private def stored(file: ByteBuffer, width: Int, height: Int, values: Long): Long =
    val isPng = file.remaining > 25 && file.get(1) == 'P' && file.get(2) == 'N'
    val channels = if isPng then PngChannels.getOrElse(file.get(25).toInt, 1) else 0
    if isPng then height * ((width.toLong * channels * file.get(24) + 7) / 8) else values

  /** The PNG colour type of images with a palette. */
  val Palette = 3

  /** Channels by PNG colour type: grey, colour, palette, and the first two with alpha. */
  val PngChannels: Map[Int, Int] = Map(0 -> 1, 2 -> 3, Palette -> 1, 4 -> 2, 6 -> 4)

  /** Upper bound of compression ratios: deflate reaches 1032, JPEG with one bit per block 1365.
    * Limits the memory that a damaged size can request; the decoder would fill it.
    */
  private[image] val MaxCompression = 1400

  private def failed(): Nothing =
    val reason = Option(STBImage.stbi_failure_reason).getOrElse("unknown reason")
    throw ImageError(Code.DamagedImage, s"can't be decoded: $reason")
