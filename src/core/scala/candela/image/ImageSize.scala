package candela.image

import candela.io.{FileName, InputFile}
import java.io.IOException
import java.nio.charset.StandardCharsets

/** Roughly how large an image is, by the beginning of its file.
  *
  * @param isBytes whether its values are of 8 bits; else they are Floats in memory
  */
final case class ImageSize(width: Int, height: Int, channels: Int, isBytes: Boolean):

  /** Bytes of its texels and their reductions. */
  def asTexture: Long =
    def enlarged(n: Int) =
      if Integer.bitCount(n) == 1 then n.toLong else Integer.highestOneBit(n) * 2L
    val values = width.toLong * height * channels
    val large = enlarged(width) * enlarged(height) * channels
    if isBytes && large == values then values + large * 4 / 3
    else large * 16 / 3 + (if isBytes then values else 4 * values)

object ImageSize:

  /** None if the file can't be read. */
  def guess(file: InputFile): Option[ImageSize] =
    try
      val start = file.beginning(1 << 16)
      png(start).orElse(jpeg(start)).orElse(exr(start)).orElse(radiance(start))
        .orElse(Some(ofLength(file)))
    catch case _: IOException => None

  private def png(bytes: Array[Byte]): Option[ImageSize] =
    Option.when(bytes.length > 25 && word(bytes, 1) == 0x504e && word(bytes, 12) == 0x4948):
      val channels = bytes(25) match
        case 0 => 1
        case 4 => 2
        case 6 => 4
        case _ => 3
      ImageSize(size(bytes, 16), size(bytes, 20), channels, isBytes = bytes(24) <= 8)

  private def jpeg(bytes: Array[Byte]): Option[ImageSize] =
    def frameFrom(at: Int): Option[ImageSize] =
      if at + 10 > bytes.length || (bytes(at) & 0xff) != 0xff then None
      else
        val kind = bytes(at + 1) & 0xff
        val isFrame = kind >= 0xc0 && kind <= 0xcf && !Set(0xc4, 0xc8, 0xcc)(kind)
        if isFrame then
          val (width, height) = (word(bytes, at + 7), word(bytes, at + 5))
          Option.when(width > 0 && height > 0)(ImageSize(width, height, bytes(at + 9), true))
        else frameFrom(at + 2 + word(bytes, at + 2))
    if bytes.length > 4 && word(bytes, 0) == 0xffd8 then frameFrom(2) else None

  /** None if the beginning of the file isn't its whole header. */
  private def exr(bytes: Array[Byte]): Option[ImageSize] =
    if !bytes.startsWith(ImageFiles.ExrMark) then None
    else
      try
        val part = ExrHeader.ofBeginning(bytes)._1.head
        val colors = StoredImage.colors(part.channels.map(_.name)).fold(1)(_.distinct.size)
        Some(ImageSize(part.width, part.height, colors, isBytes = false))
      catch case _: ImageError => None

  private val RadianceSize = """\n[-+]([XY]) (\d{1,9}) [-+][XY] (\d{1,9})\n""".r

  private def radiance(bytes: Array[Byte]): Option[ImageSize] =
    val text = String(bytes.take(1 << 12), StandardCharsets.ISO_8859_1)
    Option.when(text.startsWith("#?"))(RadianceSize.findFirstMatchIn(text)).flatten.map: size =>
      val (first, second) = (size.group(2).toInt, size.group(3).toInt)
      val (width, height) = if size.group(1) == "Y" then (second, first) else (first, second)
      ImageSize(Math.max(1, width), Math.max(1, height), 3, isBytes = false)

  /** Of other formats, which are taken as not packed. */
  private def ofLength(file: InputFile): ImageSize =
    val isFloat = FileName.isOfFloats(file.path)
    val pixels = Math.min(file.size / (if isFloat then 12 else 3), 1L << 30)
    ImageSize(Math.max(1, pixels.toInt), 1, 3, !isFloat)

  private def word(bytes: Array[Byte], at: Int): Int =
    (bytes(at) & 0xff) << 8 | bytes(at + 1) & 0xff

  private def size(bytes: Array[Byte], at: Int): Int =
    Math.max(1, word(bytes, at) << 16 | word(bytes, at + 2))
