package candela.textures

import candela.base.{indexWhere, loop}
import candela.color.Rgb
import candela.image.{ByteImage, Image, ImageBands, StoredImage}

/** Pixels of an image texture as linear numbers, in the compact form of their file: one channel, or
  * red, green and blue. Rows from the top.
  */
abstract class Texels(val width: Int, val height: Int, val channels: Int):
  /** @param texel index in row order */
  def apply(texel: Int, channel: Int): Float

  /** Writes the row `y`, channels interleaved. */
  def row(y: Int, out: Array[Float]): Unit

  /** The values of 256 codes, if the texels are bytes; else empty. */
  def meaning: Array[Float] = Array.emptyFloatArray

  /** The first texel that is no number, in row order. */
  def odd: Option[OddTexel] =
    if !mayBeOdd then None
    else
      val values = new Array[Float](width * channels)
      var oddTexel: Option[OddTexel] = None
      var y = 0
      while oddTexel.isEmpty && y < height do
        row(y, values)
        var k = 0
        while k < values.length && java.lang.Float.isFinite(values(k)) do k += 1
        if k < values.length then oddTexel = Some(OddTexel(k / channels, y, values(k)))
        y += 1
      oddTexel

  protected def mayBeOdd: Boolean = true

  /** The `i`th number as it is kept: a byte, or the bits of a Float. */
  private[textures] def code(i: Int): Int

/** A texel whose value is NaN or infinite. */
final case class OddTexel(x: Int, y: Int, value: Float)

/** Bytes, decoded by a table of 256 values. */
final class ByteTexels(
    w: Int,
    h: Int,
    channels: Int,
    bytes: Array[Byte],
    override val meaning: Array[Float]
) extends Texels(w, h, channels):
  private[textures] def code(i: Int): Int = bytes(i) & 0xff
  override protected def mayBeOdd: Boolean = !meaning.forall(java.lang.Float.isFinite(_))
  def apply(texel: Int, channel: Int): Float = meaning(bytes(texel * channels + channel) & 0xff)
  def row(y: Int, out: Array[Float]): Unit =
    val start = y * w * channels
    loop(w * channels)(k => out(k) = meaning(bytes(start + k) & 0xff))

final class FloatTexels(w: Int, h: Int, channels: Int, values: Array[Float])
    extends Texels(w, h, channels):
  private[textures] def code(i: Int): Int = java.lang.Float.floatToRawIntBits(values(i))
  def apply(texel: Int, channel: Int): Float = values(texel * channels + channel)
  def row(y: Int, out: Array[Float]): Unit =
    System.arraycopy(values, y * w * channels, out, 0, w * channels)

/** Reads texels from images. `decode` maps a stored number (0 to 1 for 8 bits) to a linear one; it
  * includes the scene's choice of encoding, e.g. `image.encoding.decode`, or for pbrt-v2 x ↦
  * (scale·x)^gamma.
  */
object Texels:

  /** Texels of a colour texture; drops alpha, and keeps one channel of a grey image. */
  def color(image: ImageBands, decode: Float => Float): TexelBands =
    val channels = channelsOf(image)
    if isGray(image, channels) then single(image, channels(0), decode)
    else
      val meaning = if image.isBytes then table(decode) else Array.emptyFloatArray
      TexelBands(image, 3, meaning):
        case stored: ByteImage =>
          ByteTexels(stored.width, stored.height, 3, selected(stored, channels), meaning)
        case floats: Image =>
          val values = new Array[Float](floats.width * floats.height * 3)
          loop(floats.width * floats.height): i =>
            loop(3)(c => values(3 * i + c) = decode(floats.data(i * floats.channels + channels(c))))
          FloatTexels(floats.width, floats.height, 3, values)

  /** A number per pixel, as in pbrt-v2 and v3: the luminance of the stored colours, decoded. The
    * weights are those of pbrt's RGB colours.
    */
  def luminance(image: ImageBands, decode: Float => Float): TexelBands =
    val channels = channelsOf(image)
    if isGray(image, channels) then single(image, channels(0), decode)
    else
      combined(image, channels): (r, g, b) =>
        decode(0.212671f * r + 0.715160f * g + 0.072169f * b)

  /** A number per pixel, as in Mitsuba: the luminance of the decoded colours. */
  def decodedLuminance(image: ImageBands, decode: Float => Float): TexelBands =
    val channels = channelsOf(image)
    if isGray(image, channels) then single(image, channels(0), decode)
    else combined(image, channels)((r, g, b) => Rgb(decode(r), decode(g), decode(b)).luminance)

  /** A number per pixel, as in pbrt-v4: alpha (decoded like a colour) if the image has alpha other
    * than 1, else the mean of the decoded colours.
    */
  def meanOrAlpha(image: ImageBands, decode: Float => Float): TexelBands =
    val channels = channelsOf(image)
    val alpha = image.channelNames.indexOf("A")
    val hasAlpha = channels.distinct.length == 3 && alpha >= 0 && !isOpaque(image, alpha)
    if hasAlpha then single(image, alpha, decode)
    else if isGray(image, channels) then single(image, channels(0), decode)
    else combined(image, channels)((r, g, b) => (decode(r) + decode(g) + decode(b)) * (1f / 3f))

  /** The values of one channel of red, green, blue and alpha; 1 if there is no alpha. */
  def channel(image: ImageBands, name: String, decode: Float => Float): TexelBands =
    val index =
      if name == "A" then image.channelNames.indexOf(name)
      else channelsOf(image)(Image.RgbNames.indexOf(name))
    if index >= 0 then single(image, index, decode)
    else
      TexelBands(image, 1, Array.emptyFloatArray): band =>
        FloatTexels(band.width, band.height, 1, Array.fill(band.width * band.height)(1f))

  /** As [[StoredImage.colorChannels]]. */
  private def channelsOf(image: ImageBands): Array[Int] =
    StoredImage.colorChannels(image.channelNames).toArray

  /** Some channels; the image's own bytes if these are all. */
  private def selected(image: ByteImage, channels: Array[Int]): Array[Byte] =
    if channels.sameElements(Array.range(0, image.channels)) then image.bytes
    else
      val bytes = new Array[Byte](image.width * image.height * channels.length)
      loop(image.width * image.height): i =>
        loop(channels.length): c =>
          bytes(channels.length * i + c) = image.bytes(i * image.channels + channels(c))
      bytes

  private def isOpaque(image: ImageBands, alpha: Int): Boolean =
    image.every(band => every(band)(i => stored(band, i * band.channels + alpha) == 1f))

  private def isGray(image: ImageBands, c: Array[Int]): Boolean =
    (image.isBytes && c.distinct.length == 1) || image.every(isGray(_, c))

  private def isGray(image: StoredImage, c: Array[Int]): Boolean = image match
    case stored: ByteImage =>
      val bytes = stored.bytes
      every(image): i =>
        val offset = i * image.channels
        bytes(offset + c(0)) == bytes(offset + c(1)) && bytes(offset + c(0)) == bytes(offset + c(2))
    case floats: Image =>
      val data = floats.data
      every(image): i =>
        val offset = i * image.channels
        data(offset + c(0)) == data(offset + c(1)) && data(offset + c(0)) == data(offset + c(2))

  private inline def every(image: StoredImage)(inline holds: Int => Boolean): Boolean =
    indexWhere(image.width * image.height)(i => !holds(i)) < 0

  private def stored(image: StoredImage, index: Int): Float = image match
    case stored: ByteImage => (stored.bytes(index) & 0xff) / 255f
    case floats: Image => floats.data(index)

  private def single(image: ImageBands, channel: Int, decode: Float => Float): TexelBands =
    val meaning = if image.isBytes then table(decode) else Array.emptyFloatArray
    TexelBands(image, 1, meaning):
      case stored: ByteImage =>
        val bytes = selected(stored, Array(channel))
        ByteTexels(stored.width, stored.height, 1, bytes, meaning)
      case floats: Image =>
        val count = floats.width * floats.height
        val values = new Array[Float](count)
        loop(count)(i => values(i) = decode(floats.data(i * floats.channels + channel)))
        FloatTexels(floats.width, floats.height, 1, values)

  private inline def combined(image: ImageBands, c: Array[Int])(
      inline f: (Float, Float, Float) => Float
  ): TexelBands =
    TexelBands(image, 1, Array.emptyFloatArray): band =>
      val values = new Array[Float](band.width * band.height)
      loop(values.length): i =>
        val offset = i * band.channels
        values(i) =
          f(stored(band, offset + c(0)), stored(band, offset + c(1)), stored(band, offset + c(2)))
      FloatTexels(band.width, band.height, 1, values)

  private def table(decode: Float => Float): Array[Float] =
    Array.tabulate(256)(code => decode(code / 255f))
