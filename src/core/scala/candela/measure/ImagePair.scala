package candela.measure

import candela.base.loop
import candela.diagnostics.Code
import candela.image.{Image, ImageError}

/** Half-open pixel bounds: x0 ≤ x < x1, y0 ≤ y < y1. */
final case class PixelWindow(x0: Int, x1: Int, y0: Int, y1: Int):

  /** Crops an image.
    *
    * @throws ImageError if the window exceeds the image
    */
  def of(image: Image): Image =
    if x0 < 0 || y0 < 0 || x1 > image.width || y1 > image.height || x0 >= x1 || y0 >= y1 then
      val size = s"${image.width}×${image.height}"
      throw ImageError(
        Code.DifferentImages,
        s"window x $x0 to $x1, y $y0 to $y1 is outside the image of $size pixels"
      )
    val row = (x1 - x0) * image.channels
    val data = new Array[Float](row * (y1 - y0))
    loop(y1 - y0): y =>
      val offset = ((y + y0) * image.width + x0) * image.channels
      System.arraycopy(image.data, offset, data, y * row, row)
    Image(x1 - x0, y1 - y0, image.channelNames, data, image.encoding, image.colorSpace)

/** An image and its reference, of equal size, in linear values, colours in sRGB. Both have
  * exactly `channels`, in this order.
  */
final class ImagePair private (val image: Image, val reference: Image):
  def width: Int = image.width
  def height: Int = image.height
  def channels: Vector[String] = image.channelNames
  def isColor: Boolean = channels == Image.RgbNames

  /** Whether the pixel is finite in both images. */
  def isFinite(x: Int, y: Int): Boolean =
    var finite = true
    loop(channels.size): c =>
      if !java.lang.Float.isFinite(image(x, y, c)) || !java.lang.Float.isFinite(reference(x, y, c))
      then finite = false
    finite

  /** The pair with black pixels in both images where one has a pixel that isn't finite. */
  def withBlackGaps: ImagePair =
    val gaps = (0 until width * height).filterNot(i => isFinite(i % width, i / width))
    def blackened(from: Image): Image =
      val data = from.data.clone
      for i <- gaps do loop(channels.size)(c => data(i * channels.size + c) = 0f)
      Image(width, height, channels, data)
    if gaps.isEmpty then this else new ImagePair(blackened(image), blackened(reference))

  def cropped(window: PixelWindow): ImagePair =
    new ImagePair(window.of(image), window.of(reference))

  /** Absolute difference |a − b| per channel. */
  def difference: Image =
    val data = new Array[Float](image.data.length)
    loop(data.length)(i => data(i) = Math.abs(image.data(i) - reference.data(i)))
    Image(width, height, channels, data)

object ImagePair:

  /** Pairs R, G and B if both images have them, else all channels, which must be equal.
    *
    * @throws ImageError if sizes or channels differ
    */
  def apply(image: Image, reference: Image): ImagePair =
    this.of(image, reference, commonChannels(image, reference))

  /** Pairs the named channels only: those of a layer, such as `Denoised.R`, with `R` of a reference
    * that lacks the layer.
    */
  def of(image: Image, reference: Image, channels: Vector[String]): ImagePair =
    if image.width != reference.width || image.height != reference.height then
      def size(i: Image) = s"${i.width}×${i.height}"
      throw ImageError(
        Code.DifferentImages,
        s"image sizes differ: ${size(image)} and ${size(reference)} pixels; render " +
          s"with --resolution ${reference.width}x${reference.height}, or resize or cut one " +
          "with `candela image`"
      )
    val chosen = picked(image, channels, "image")
    if channels.forall(reference.channelNames.contains) then
      new ImagePair(chosen, picked(reference, channels, "reference"))
    else
      val plain = channels.map(c => c.drop(c.lastIndexOf('.') + 1))
      val renamed =
        Image(chosen.width, chosen.height, plain, chosen.data, colorSpace = image.colorSpace)
      new ImagePair(picked(renamed, plain, "image"), picked(reference, plain, "reference"))

  private def commonChannels(image: Image, reference: Image): Vector[String] =
    val isColor = image.indicesOf(Image.RgbNames).isDefined &&
      reference.indicesOf(Image.RgbNames).isDefined
    if isColor then Image.RgbNames
    else if image.channelNames.toSet == reference.channelNames.toSet then reference.channelNames
    else
      def list(i: Image) = i.channelNames.mkString(", ")
      throw ImageError(
        Code.DifferentImages,
        s"image channels differ: ${list(image)} and ${list(reference)}"
      )

  private def picked(image: Image, names: Vector[String], role: String): Image =
    val isConverted = names == Image.RgbNames && !image.colorSpace.isSrgb
    val linear = if isConverted then image.toRgb else image.premultiplied
    if linear.channelNames == names then linear
    else
      val missing = names.filterNot(linear.channelNames.contains)
      if missing.nonEmpty then
        val available = linear.channelNames.mkString(", ")
        throw ImageError(
          Code.DifferentImages,
          s"the $role has no channel ${missing.mkString(", ")}; known: $available"
        )
      val sources = names.map(linear.channelNames.indexOf).toArray
      val count = names.size
      val data = new Array[Float](linear.width * linear.height * count)
      loop(linear.width * linear.height): pixel =>
        loop(count): c =>
          data(pixel * count + c) = linear.data(pixel * linear.channels + sources(c))
      Image(linear.width, linear.height, names, data)
