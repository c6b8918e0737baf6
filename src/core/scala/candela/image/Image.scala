package candela.image

import candela.base.loop
import candela.diagnostics.Code
import candela.color.{ColorSpace, Encoding, Matrix3, Rgb}

/** An image can't be read or written: cause and cure on one line. Not a bug, so without a stack
  * trace.
  */
final class ImageError(val code: Code, message: String)
    extends RuntimeException(message, null, false, false)

/** An image as stored in its file: `channels` numbers per pixel, interleaved; rows from the top.
  */
sealed abstract class StoredImage:
  def width: Int
  def height: Int
  def channelNames: Vector[String]

  /** Transfer function of the stored numbers. */
  def encoding: Encoding

  /** Colour space of R, G and B. */
  def colorSpace: ColorSpace
  def toImage: Image

  /** Of all stored numbers, decoded. */
  protected def decoded(i: Int): Float

  def channels: Int

  /** Indices of the named channels, if all are present. */
  final def indicesOf(names: Vector[String]): Option[Vector[Int]] =
    StoredImage.indicesOf(channelNames, names)

  /** The colour channels: R, G and B, or Y or the only channel three times.
    *
    * @throws ImageError if there are none of these
    */
  final def colorChannels: Vector[Int] = StoredImage.colorChannels(channelNames)

  /** Linear sRGB; grey images become three equal channels, all other channels are dropped.
    *
    * @throws ImageError if it has neither R, G, B nor Y
    */
  def toRgb: Image = inSrgb(colorSpace.toSrgb)

  /** As `toRgb`, of reflectances: white stays white. */
  final def toReflectances: Image = inSrgb(colorSpace.toSrgbAdapted)

  private def inSrgb(matrix: => Matrix3): Image =
    val sources = colorChannels.toArray
    val (picked, channelCount) = (Image.rgb(width, height), channels)
    loop(width * height): pixel =>
      loop(3)(c => picked.data(3 * pixel + c) = decoded(pixel * channelCount + sources(c)))
    val isGray = sources.distinct.length == 1
    if colorSpace.isSrgb || isGray then picked
    else
      val change = matrix
      picked.mapped(change * _, picked.data)

object StoredImage:
  private def indicesOf(available: Vector[String], names: Vector[String]): Option[Vector[Int]] =
    val indices = names.map(available.indexOf)
    Option.when(indices.forall(_ >= 0))(indices)

  /** The colour channels of images whose channels have these names, as [[colorChannels]]. */
  def colors(names: Vector[String]): Option[Vector[Int]] =
    indicesOf(names, Image.RgbNames)
      .orElse(indicesOf(names, Vector("Y")).map(y => Vector.fill(3)(y.head)))
      .orElse(Option.when(names.size == 1)(Vector.fill(3)(0)))

  /** @throws ImageError if there are none */
  def colorChannels(names: Vector[String]): Vector[Int] =
    colors(names).getOrElse(throw ImageError(
      Code.ImageContents,
      s"no channels R, G, B or Y, only ${names.mkString(", ")}"
    ))

/** An image of Floats, in the layout of [[StoredImage]]; linear by default. */
final class Image(
    val width: Int,
    val height: Int,
    val channelNames: Vector[String],
    val data: Array[Float],
    val encoding: Encoding = Encoding.Linear,
    val colorSpace: ColorSpace = ColorSpace.Srgb
) extends StoredImage:
  val channels: Int = channelNames.size
  require(data.length == width.toLong * height * channels, s"$width×$height×$channels")

  def apply(x: Int, y: Int, channel: Int): Float = data((y * width + x) * channels + channel)

  def toImage: Image = this
  protected def decoded(i: Int): Float = encoding.decode(data(i))

  /** The same image, decoded to linear values; alpha is never encoded. */
  def linear: Image =
    if encoding == Encoding.Linear then this
    else
      val isColor = channelNames.map(_ != "A").toArray
      val decoded = new Array[Float](data.length)
      loop(data.length): i =>
        decoded(i) = if isColor(i % channels) then encoding.decode(data(i)) else data(i)
      Image(width, height, channelNames, decoded, colorSpace = colorSpace)

  /** The same image, linear and with colours multiplied by alpha, as renderings have them: images
    * of 8 and 16 bits have straight alpha.
    */
  def premultiplied: Image =
    val decoded = linear
    val alpha = channelNames.indexOf("A")
    if encoding != Encoding.Linear && alpha >= 0 then
      loop(data.length): i =>
        val c = i % channels
        if c != alpha then decoded.data(i) *= decoded.data(i - c + alpha)
    decoded

  /** With its last row first. */
  def upsideDown: Image =
    val row = channels * width
    val turned = new Array[Float](data.length)
    loop(height): y =>
      System.arraycopy(data, y * row, turned, data.length - (y + 1) * row, row)
    Image(width, height, channelNames, turned, encoding, colorSpace)

  override def toRgb: Image =
    if encoding == Encoding.Linear && colorSpace.isSrgb && channelNames == Image.RgbNames then this
    else super.toRgb

  /** Three of its channels as R, G and B. */
  def selected(three: Vector[Int]): Image =
    require(three.size == 3, three)
    val picked = new Array[Float](3 * width * height)
    loop(width * height): pixel =>
      loop(3)(c => picked(3 * pixel + c) = data(pixel * channels + three(c)))
    Image(width, height, Image.RgbNames, picked, encoding, colorSpace)

  /** Other colours in its place; it has the channels R, G and B only.
    *
    * @param changed where they are written, which may be the data of an image that nothing else has
    */
  def mapped(
      change: Rgb => Rgb,
      changed: Array[Float] = new Array[Float](data.length)
  ): Image =
    require(channelNames == Image.RgbNames, channelNames)
    loop(width * height): pixel =>
      val offset = 3 * pixel
      val c = change(Rgb(data(offset), data(offset + 1), data(offset + 2)))
      changed(offset) = c.r
      changed(offset + 1) = c.g
      changed(offset + 2) = c.b
    Image(width, height, channelNames, changed)

object Image:
  val RgbNames: Vector[String] = Vector("R", "G", "B")
  def rgb(width: Int, height: Int): Image =
    Image(width, height, RgbNames, new Array[Float](valueCount(width, height, 3)))

  /** Number of values of an image.
    *
    * @throws ImageError if an array can't have as many
    */
  def valueCount(width: Int, height: Int, channels: Int): Int =
    val count = width.toLong * height * channels
    if count > MaxValues then
      throw ImageError(
        Code.TooLarge,
        s"$width×$height pixels of $channels channels are too many for an image"
      )
    count.toInt

  /** Of arrays in Java. */
  private val MaxValues = Int.MaxValue - 8

/** An 8-bit image of sRGB colours; value 255 stands for 1. */
final class ByteImage(
    val width: Int,
    val height: Int,
    val channelNames: Vector[String],
    val bytes: Array[Byte],
    val encoding: Encoding
) extends StoredImage:
  val channels: Int = channelNames.size
  def colorSpace: ColorSpace = ColorSpace.Srgb
  require(bytes.length == width.toLong * height * channels, s"$width×$height×$channels")

  /** The values in [0, 1], still encoded. */
  def toImage: Image =
    val data = new Array[Float](bytes.length)
    loop(bytes.length)(i => data(i) = (bytes(i) & 0xff) / 255f)
    Image(width, height, channelNames, data, encoding)

  private lazy val decodedBytes = Array.tabulate(256)(value => encoding.decode(value / 255f))
  protected def decoded(i: Int): Float = decodedBytes(bytes(i) & 0xff)
