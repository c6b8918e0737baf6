package candela.image

import java.nio.{ByteBuffer, ByteOrder}

/** Detects truncated files of formats whose decoder does not. */
private[image] object CutFile:

  /** A message if the file is truncated.
    *
    * @param start the first bytes
    * @param end   the last ones
    * @param size  of the file
    */
  def remark(suffix: String, start: Array[Byte], end: Array[Byte], size: Long): Option[String] =
    val buffer = ByteBuffer.wrap(start).order(ByteOrder.LITTLE_ENDIAN)
    val isCut = suffix match
      // Files of other formats are read as what they are
      case "jpg" | "jpeg" => start.startsWith(JpegMark) && !hasEndOfImage(end)
      case "bmp" => start.startsWith(BmpMark) && start.length >= BmpHeader && size < bmpSize(buffer)
      case "tga" => start.length >= TgaHeader && size < tgaSize(buffer)
      case _ => false
    Option.when(isCut)(Missing)

  /** Whether [[packed]] knows more than [[remark]]. */
  def isPacked(suffix: String, start: Array[Byte]): Boolean = suffix match
    case "qoi" => start.startsWith(QoiMark)
    case "tga" => start.length >= TgaHeader && PackedTgas(start(2) & 0xff)
    case _ => false

  /** A message if compressed pixels are truncated; counts all of them. */
  def packed(file: Array[Byte]): Option[String] =
    val isCut = if file.startsWith(QoiMark) then Qoi.isShort(file) else isShortTga(file)
    Option.when(isCut)(Missing)

  private val Missing = "the file is cut short: some of its pixels are missing"
  private val QoiMark = "qoif".getBytes
  private val BmpMark = "BM".getBytes
  private val JpegMark = Array(0xff, 0xd8).map(_.toByte)
  private val PackedTgas = Set(9, 10, 11)

  /** Whether packets of pixels end before the image does. */
  private def isShortTga(file: Array[Byte]): Boolean =
    val buffer = ByteBuffer.wrap(file).order(ByteOrder.LITTLE_ENDIAN)
    def byte(i: Int) = buffer.get(i) & 0xff
    def short(i: Int) = buffer.getShort(i) & 0xffffL
    val pixelBytes = (byte(16) + 7) / 8
    var remainingPixels = short(12) * short(14)
    var offset = TgaHeader + byte(0) + (if byte(1) == 1 then short(5) * ((byte(7) + 7) / 8) else 0L)
    while remainingPixels > 0 && offset < file.length do
      val packet = byte(offset.toInt)
      val count = (packet & 127) + 1
      remainingPixels -= count
      offset += 1 + pixelBytes * (if packet > 127 then 1 else count)
    remainingPixels > 0 || offset > file.length

  /** Whether the marker is there, which can't be within coded pixels. */
  private def hasEndOfImage(end: Array[Byte]): Boolean =
    end.indices.drop(1).exists(i => end(i - 1) == 0xff.toByte && end(i) == 0xd9.toByte)

  /** Of uncompressed pixels; 0 of others. */
  private def bmpSize(in: ByteBuffer): Long =
    val (width, height) = (in.getInt(18).toLong, Math.abs(in.getInt(22).toLong))
    val isPlain = in.getInt(30) == 0
    if isPlain then in.getInt(10) + (width * in.getShort(28) + 31) / 32 * 4 * height else 0

  /** Of uncompressed pixels; 0 of others. */
  private def tgaSize(in: ByteBuffer): Long =
    def byte(i: Int) = in.get(i) & 0xff
    def short(i: Int) = in.getShort(i) & 0xffffL
    val palette = if byte(1) == 1 then short(5) * ((byte(7) + 7) / 8) else 0
    val pixels = short(12) * short(14) * ((byte(16) + 7) / 8)
    if byte(2) >= 1 && byte(2) <= 3 then TgaHeader + byte(0) + palette + pixels else 0

  private val BmpHeader = 34
  private val TgaHeader = 18
