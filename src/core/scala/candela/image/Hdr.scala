package candela.image

import candela.base.loop
import candela.diagnostics.Code
import java.nio.charset.StandardCharsets.ISO_8859_1

/** Reads Radiance RGBE images (.hdr), run-length encoded or flat, as R, G and B.
  *
  * A mantissa byte m with exponent byte e stands for m·2^(e − 136), 0 if e is 0. `EXPOSURE` lines
  * are ignored, as in pbrt: the values are those of the file.
  *
  * Source: Ward, "Real Pixels", Graphics Gems II, 1991; Radiance's file format reference, "Picture
  * File Format (.hdr)".
  */
private[image] object Hdr:

  def read(file: Array[Byte]): Image = Reader(file).image()

  /** Upper bound of all encodings: old-style runs hold 255 pixels in 4 bytes. Limits the memory
    * that a damaged size can request.
    */
  private val MaxPixelsPerByte = 64

  private final class Reader(file: Array[Byte]):
    private var cursor = 0

    def image(): Image =
      header()
      val (width, height, fromBottom, fromRight) = resolution()
      val available = (file.length - cursor).toLong * MaxPixelsPerByte
      if width.toLong * height > Math.min(available, (Int.MaxValue - 8) / 3) then
        throw ImageError(
          Code.DamagedImage,
          s"$width×$height pixels can't be in a file of ${file.length} bytes"
        )
      val result = Image.rgb(width, height)
      val row = new Array[Byte](4 * width)
      loop(height): i =>
        scanline(row, width)
        val y = if fromBottom then height - 1 - i else i
        loop(width): j =>
          val x = if fromRight then width - 1 - j else j
          store(row, j, result.data, 3 * (y * width + x))
      result

    private def header(): Unit =
      var headerLine = line()
      while headerLine.nonEmpty do
        headerLine match
          case s"FORMAT=$format" if format.trim != "32-bit_rle_rgbe" =>
            throw ImageError(
              Code.UnsupportedImage,
              s"pixel format `${format.trim}`: only 32-bit_rle_rgbe is supported"
            )
          case _ => ()
        headerLine = line()

    /** Width, height, whether rows run from the bottom, whether columns run from the right. */
    private def resolution(): (Int, Int, Boolean, Boolean) =
      val text = line()
      val form = raw"([+-])Y +(\d{1,9}) +([+-])X +(\d{1,9})".r
      text.trim match
        case form(ySign, h, xSign, w) if h.toInt > 0 && w.toInt > 0 =>
          (w.toInt, h.toInt, ySign == "+", xSign == "-")
        case other =>
          throw ImageError(
            Code.DamagedImage,
            s"expected a size such as `-Y 480 +X 640`, found `${other.take(40)}`"
          )

    private def line(): String =
      val start = cursor
      while cursor < file.length && file(cursor) != '\n' do cursor += 1
      if cursor == file.length then throw ImageError(Code.DamagedImage, "the header does not end")
      cursor += 1
      String(file, start, cursor - 1 - start, ISO_8859_1).stripSuffix("\r")

    private def byte(): Int =
      if cursor >= file.length then
        throw ImageError(Code.DamagedImage, "the file ends within the pixels")
      cursor += 1
      file(cursor - 1) & 0xff

    private def scanline(row: Array[Byte], width: Int): Unit =
      val coded = width >= 8 && width <= 0x7fff && file.length - cursor >= 4 &&
        file(cursor) == 2 && file(cursor + 1) == 2 && file(cursor + 2) >= 0
      if coded then
        cursor += 2
        if (byte() << 8 | byte()) != width then
          throw ImageError(Code.DamagedImage, "a row of another width")
        loop(4)(component => runs(row, component, width))
      else flat(row, width)

    /** Decodes one component of a scanline: counts above 128 repeat the byte that follows, others
      * copy.
      */
    private def runs(row: Array[Byte], component: Int, width: Int): Unit =
      var x = 0
      while x < width do
        val code = byte()
        val count = if code > 128 then code - 128 else code
        if count == 0 || x + count > width then
          throw ImageError(Code.DamagedImage, "a run exceeds its row")
        if code > 128 then
          val value = byte().toByte
          loop(count)(i => row(4 * (x + i) + component) = value)
        else loop(count)(i => row(4 * (x + i) + component) = byte().toByte)
        x += count

    /** Decodes whole pixels; a pixel with mantissas 1, 1, 1 repeats the previous one e times, and
      * in a sequence of such pixels each further count has 256 times the weight.
      */
    private def flat(row: Array[Byte], width: Int): Unit =
      var x = 0
      var shift = 0
      while x < width do
        val (r, g, b, e) = (byte(), byte(), byte(), byte())
        if r == 1 && g == 1 && b == 1 then
          val count = if shift > 16 then -1L else e.toLong << shift
          if x == 0 || count < 0 || x + count > width then
            throw ImageError(Code.DamagedImage, "a run exceeds its row")
          loop(count.toInt)(i => System.arraycopy(row, 4 * (x - 1), row, 4 * (x + i), 4))
          x += count.toInt
          shift += 8
        else
          row(4 * x) = r.toByte
          row(4 * x + 1) = g.toByte
          row(4 * x + 2) = b.toByte
          row(4 * x + 3) = e.toByte
          x += 1
          shift = 0

    private def store(row: Array[Byte], pixel: Int, data: Array[Float], to: Int): Unit =
      val exponent = row(4 * pixel + 3) & 0xff
      if exponent != 0 then
        val scale = Math.scalb(1.0, exponent - 136)
        loop(3)(c => data(to + c) = ((row(4 * pixel + c) & 0xff) * scale).toFloat)
