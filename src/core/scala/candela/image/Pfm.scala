package candela.image

import candela.base.{Decimal, loop}
import candela.diagnostics.Code
import java.nio.charset.StandardCharsets.US_ASCII
import java.nio.{ByteBuffer, ByteOrder}

/** Portable float maps: R, G and B (`PF`) or Y (`Pf`), rows from the bottom.
  *
  * The third word of the header is a factor of all values; it is negative if they are
  * little-endian.
  *
  * Source: Debevec, "PFM Portable FloatMap Image Format", pauldebevec.com.
  */
private[image] object Pfm extends OutputFormat("pfm", Contents.Radiance):

  def read(file: Array[Byte]): Image =
    val words = Words(file)
    val names = words.next("type") match
      case "PF" => Image.RgbNames
      case _ => Vector("Y")
    val (width, height) = (size(words.next("width")), size(words.next("height")))
    val word = words.next("scale")
    val scale = Decimal.float(word).filter(s => s != 0f && java.lang.Float.isFinite(s))
      .getOrElse(throw ImageError(Code.DamagedImage, s"expected a scale such as -1, found `$word`"))
    val count = width.toLong * height * names.size
    val available = file.length - words.position
    if count * 4 > available then
      throw ImageError(
        Code.DamagedImage,
        s"$width×$height pixels need ${count * 4} bytes, found $available"
      )
    val order = if scale < 0f then ByteOrder.LITTLE_ENDIAN else ByteOrder.BIG_ENDIAN
    val values = ByteBuffer.wrap(file, words.position, available).slice.order(order).asFloatBuffer
    val data = new Array[Float](count.toInt)
    val row = width * names.size
    loop(height): y =>
      val _ = values.get(y * row, data, (height - 1 - y) * row, row)
    val factor = Math.abs(scale)
    if factor != 1f then loop(data.length)(i => data(i) *= factor)
    Image(width, height, names, data)

  private[image] override def hasEnd(file: Array[Byte]): Boolean =
    val words = Words(file)
    val values = if words.next("type") == "PF" then 3L else 1L
    val (width, height) = (size(words.next("width")), size(words.next("height")))
    val _ = words.next("scale")
    file.length == words.position + 4 * values * width * height

  /** Little-endian, as most programs expect. */
  def write(image: Image, metadata: Vector[(String, String)], options: WriteOptions): Array[Byte] =
    val isGray = image.indicesOf(Image.RgbNames).isEmpty
    val source = if isGray then image.linear else image.toRgb
    val channels = source.colorChannels.distinct
    val kind = if isGray then "Pf" else "PF"
    val header = s"$kind\n${image.width} ${image.height}\n-1.0\n".getBytes(US_ASCII)
    val size = header.length + 4L * image.width * image.height * channels.size
    if size > Int.MaxValue - 8 then throw ImageError(Code.TooLarge, "a PFM file of more than 2 GB")
    val bytes = ByteBuffer.allocate(size.toInt).order(ByteOrder.LITTLE_ENDIAN).put(header)
    for y <- image.height - 1 to 0 by -1; x <- 0 until image.width; c <- channels do
      val _ = bytes.putFloat(source(x, y, c))
    bytes.array

  private def size(word: String): Int =
    word.toIntOption.filter(_ > 0).getOrElse(throw ImageError(
      Code.DamagedImage,
      s"expected a size, found `$word`"
    ))

  /** The words of the header, each ended by one or more blanks; a single one ends the last. */
  private final class Words(file: Array[Byte]):
    var position = 0

    def next(what: String): String =
      while position < file.length && isBlank(position) do position += 1
      val start = position
      while position < file.length && position - start < 32 && !isBlank(position) do position += 1
      if position == file.length || !isBlank(position) then
        throw ImageError(Code.DamagedImage, s"its header has no $what")
      position += 1
      // A line end of two bytes
      if file(position - 1) == '\r' && position < file.length && file(position) == '\n' then
        position += 1
      String(file, start, position - start, US_ASCII).trim

    private def isBlank(i: Int) = file(i) == ' ' || (file(i) >= '\t' && file(i) <= '\r')
