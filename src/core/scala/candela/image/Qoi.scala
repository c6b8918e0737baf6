package candela.image

import candela.base.loop
import candela.diagnostics.Code
import candela.color.Encoding

import java.io.ByteArrayOutputStream
import java.nio.ByteBuffer

/** QOI, the Quite OK Image Format: 8 bits per channel, lossless, R, G, B and perhaps A.
  *
  * Source: Szablewski, "The Quite OK Image Format Specification", version 1.0, qoiformat.org.
  */
private[image] object Qoi extends OutputFormat("qoi", Contents.Display):
  private val Mark = "qoif".getBytes
  private val HeaderSize = 14

  /** Seven zeros and a one end the file. */
  private val End = Array[Byte](0, 0, 0, 0, 0, 0, 0, 1)
  private val LongestRun = 62

  private inline val ByIndex = 0
  private inline val ByDifference = 1
  private inline val ByLuma = 2
  private inline val Rgb = 0xfe
  private inline val Rgba = 0xff

  private def slot(pixel: Array[Int]): Int =
    (3 * pixel(0) + 5 * pixel(1) + 7 * pixel(2) + 11 * pixel(3)) & 63

  /** @param admit receives width and height before the pixels are decoded */
  def read(file: Array[Byte], admit: (Int, Int) => Unit = (_, _) => ()): ByteImage =
    if file.length < HeaderSize + End.length then
      throw ImageError(Code.DamagedImage, "the file is cut short")
    val header = ByteBuffer.wrap(file)
    val (width, height) = (header.getInt(4), header.getInt(8))
    admit(width, height)
    val (channels, coding) = (file(12).toInt, file(13).toInt)
    if channels != 3 && channels != 4 then
      throw ImageError(Code.DamagedImage, s"$channels channels, expected 3 or 4")
    if coding != 0 && coding != 1 then
      throw ImageError(Code.DamagedImage, s"unknown colour space $coding")
    val fits = width > 0 && height > 0 && width.toLong * height <= (Int.MaxValue - 8) / channels
    if !fits || width.toLong * height > file.length.toLong * LongestRun then
      val size = s"${width & 0xffffffffL}×${height & 0xffffffffL}"
      throw ImageError(
        Code.DamagedImage,
        s"$size pixels can't be in a file of ${file.length} bytes"
      )
    val bytes = new Array[Byte](width * height * channels)
    Decoder(file, channels).decode(bytes)
    val names = if channels == 4 then Image.RgbNames :+ "A" else Image.RgbNames
    val encoding = if coding == 0 then Encoding.Srgb else Encoding.Linear
    ByteImage(width, height, names, bytes, encoding)

  /** Whether the file has fewer pixels than its header says: pbrt-v4 repeats the last one. */
  def isShort(file: Array[Byte]): Boolean =
    file.length >= HeaderSize + End.length && {
      val header = ByteBuffer.wrap(file)
      val decoder = Decoder(file, 3)
      var remaining = (header.getInt(4) & 0xffffffffL) * (header.getInt(8) & 0xffffffffL)
      while remaining > 0 && !decoder.isAtEnd do remaining -= decoder.pixels()
      remaining > 0
    }

  private final class Decoder(file: Array[Byte], channels: Int):
    private var cursor = HeaderSize
    private val pixel = Array(0, 0, 0, 255)
    private val recentPixels = Array.ofDim[Int](64, 4)

    /** The last bytes are never pixels, even if the file is cut. */
    def isAtEnd: Boolean = cursor >= file.length - End.length

    def decode(target: Array[Byte]): Unit =
      var to = 0
      while to < target.length do
        var count = if isAtEnd then target.length else pixels()
        while count > 0 && to < target.length do
          loop(channels)(c => target(to + c) = pixel(c).toByte)
          to += channels
          count -= 1

    /** Reads a code and sets `pixel`; returns how many such pixels follow. */
    def pixels(): Int =
      val code = byte()
      var count = 1
      if code == Rgb then loop(3)(c => pixel(c) = byte())
      else if code == Rgba then loop(4)(c => pixel(c) = byte())
      else
        code >> 6 match
          case ByIndex => System.arraycopy(recentPixels(code & 63), 0, pixel, 0, 4)
          case ByDifference => add((code >> 4 & 3) - 2, (code >> 2 & 3) - 2, (code & 3) - 2)
          case ByLuma =>
            val green = (code & 63) - 32
            val redBlue = byte()
            add(green + (redBlue >> 4) - 8, green, green + (redBlue & 15) - 8)
          case _ => count = (code & 63) + 1
      System.arraycopy(pixel, 0, recentPixels(slot(pixel)), 0, 4)
      count

    private def add(r: Int, g: Int, b: Int): Unit =
      pixel(0) = (pixel(0) + r) & 255
      pixel(1) = (pixel(1) + g) & 255
      pixel(2) = (pixel(2) + b) & 255

    private def byte(): Int =
      cursor += 1
      file(cursor - 1) & 255

  private[image] override def hasEnd(file: Array[Byte]): Boolean =
    file.takeRight(End.length).sameElements(End)

  /** Three channels, sRGB-encoded; values clamped to [0, 1], NaN black. */
  def write(image: Image, metadata: Vector[(String, String)], options: WriteOptions): Array[Byte] =
    val picture = Bitmap.of(image, options.display.copy(bits = 8))
    val (width, height) = (picture.getWidth, picture.getHeight)
    val output = ByteArrayOutputStream()
    val header = ByteBuffer.allocate(HeaderSize).put(Mark).putInt(width).putInt(height)
    output.writeBytes(header.put(3.toByte).put(0.toByte).array)
    val bands = picture.getRaster.getNumBands
    val row = new Array[Int](width * bands)
    val encoder = Encoder(output)
    loop(height): y =>
      val _ = picture.getRaster.getPixels(0, y, width, 1, row)
      loop(width)(x =>
        encoder.add(row(x * bands), row(x * bands + bands / 2), row((x + 1) * bands - 1))
      )
    encoder.end()
    output.writeBytes(End)
    output.toByteArray

  private final class Encoder(out: ByteArrayOutputStream):
    private val previous = Array(0, 0, 0, 255)
    private val recentPixels = Array.ofDim[Int](64, 4)
    private var run = 0

    def add(r: Int, g: Int, b: Int): Unit =
      if r == previous(0) && g == previous(1) && b == previous(2) then
        run += 1
        if run == LongestRun then end()
      else
        end()
        // Differences are modulo 256
        val dr = (r - previous(0)).toByte.toInt
        val dg = (g - previous(1)).toByte.toInt
        val db = (b - previous(2)).toByte.toInt
        previous(0) = r
        previous(1) = g
        previous(2) = b
        val index = slot(previous)
        if java.util.Arrays.equals(recentPixels(index), previous) then out.write(index)
        else if isSmall(dr, 2) && isSmall(dg, 2) && isSmall(db, 2) then
          out.write(ByDifference << 6 | (dr + 2) << 4 | (dg + 2) << 2 | (db + 2))
        else if isSmall(dg, 32) && isSmall(dr - dg, 8) && isSmall(db - dg, 8) then
          out.write(ByLuma << 6 | (dg + 32))
          out.write((dr - dg + 8) << 4 | (db - dg + 8))
        else
          out.write(Rgb)
          for value <- Array(r, g, b) do out.write(value)
        System.arraycopy(previous, 0, recentPixels(index), 0, 4)

    /** Writes the open run. */
    def end(): Unit =
      if run > 0 then out.write(3 << 6 | (run - 1))
      run = 0

    private def isSmall(d: Int, bound: Int) = -bound <= d && d < bound
