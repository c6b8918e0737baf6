package candela.report

import candela.base.loop
import candela.image.Image

import java.io.ByteArrayOutputStream
import java.util.Base64
import java.util.zip.{Deflater, DeflaterOutputStream}

/** Encodes images for a page as numbers, so that the page computes exposure and errors itself.
  *
  * Keeps the upper three bytes of each Float, a relative error of 2⁻¹⁶ and far below noise. Stores
  * all first bytes, then all second and all third bytes, compressed with zlib, in base 64.
  */
private[report] object PackedPicture:

  def floats(image: Image): String =
    val count = image.data.length
    val bytes = new Array[Byte](3 * count)
    loop(count): i =>
      // Rounds off the dropped byte.
      val bits = java.lang.Float.floatToRawIntBits(image.data(i))
      val rounded = if java.lang.Float.isFinite(image.data(i)) then bits + 0x80 else bits
      loop(3)(plane => bytes(plane * count + i) = (rounded >>> (24 - 8 * plane)).toByte)
    packed(bytes)

  /** One channel with values [0, 1], quantised to 8 bits. */
  def bytes(map: Image): String =
    packed(map.data.map(v => Math.round(Math.min(1f, Math.max(0f, v)) * 255).toByte))

  /** Downsampled by two (2×2 averages) until it has at most `limit` pixels. */
  def reduced(image: Image, limit: Int = MaxPixels): Image =
    if image.width.toLong * image.height <= limit || image.width < 2 || image.height < 2 then image
    else reduced(halved(image), limit)

  /** About 20 MB of page for two images. */
  val MaxPixels = 2_000_000

  private def halved(image: Image): Image =
    val (width, height, n) = (image.width / 2, image.height / 2, image.channels)
    val data = new Array[Float](width * height * n)
    loop(height): y =>
      loop(width): x =>
        loop(n): c =>
          val top = image(2 * x, 2 * y, c) + image(2 * x + 1, 2 * y, c)
          val bottom = image(2 * x, 2 * y + 1, c) + image(2 * x + 1, 2 * y + 1, c)
          data((y * width + x) * n + c) = (top + bottom) / 4
    Image(width, height, image.channelNames, data)

  private def packed(bytes: Array[Byte]): String =
    val buffer = ByteArrayOutputStream()
    val deflater = Deflater(Deflater.BEST_COMPRESSION)
    val zip = DeflaterOutputStream(buffer, deflater)
    try
      zip.write(bytes)
      zip.close()
    finally deflater.end()
    Base64.getEncoder.encodeToString(buffer.toByteArray)
