package candela.image

import candela.base.loop
import candela.diagnostics.Code
import candela.color.{ColorSpace, Rgb}

/** Changes of linear images that keep all of their channels. */
object ImageEdits:

  /** The named channels alone, in this order.
    *
    * @throws ImageError if one is missing
    */
  def select(image: Image, names: Vector[String]): Image =
    val missing = names.filterNot(image.channelNames.contains)
    if missing.nonEmpty then
      throw ImageError(
        Code.ImageEdit,
        s"no channel ${missing.mkString(", ")}, only ${image.channelNames.mkString(", ")}"
      )
    val indices = names.map(image.channelNames.indexOf).toArray
    val data = new Array[Float](image.width * image.height * indices.length)
    loop(data.length): i =>
      data(i) = image.data(i / indices.length * image.channels + indices(i % indices.length))
    Image(image.width, image.height, names, data, image.encoding, image.colorSpace)

  /** How a picture shows an image: X, Y and Z are converted; the three channels of a layer, such as
    * `N.X`, `N.Y` and `N.Z`, are taken as R, G and B. Other images are returned as they are.
    */
  def layerAsColors(source: Image): Image =
    val image = PixelFormat.colors(source)
    val components = image.channelNames.map(_.split('.').last)
    if components == Image.RgbNames || components == Vector("X", "Y", "Z") then
      Image(image.width, image.height, Image.RgbNames, image.data, image.encoding, image.colorSpace)
    else image

  /** All channels times a factor, except alpha. */
  def scaled(image: Image, factor: Float): Image =
    val isScaled = image.channelNames.map(_ != "A").toArray
    val data = image.data.clone
    loop(data.length)(i => if isScaled(i % image.channels) then data(i) *= factor)
    withData(image, data)

  /** Red, green and blue, each pixel divided by its alpha; where that is 0, as they are.
    *
    * @throws ImageError if there are no colours
    */
  def divided(image: Image, alpha: Array[Float]): Image =
    val colors = image.colorChannels
    val data = new Array[Float](3 * alpha.length)
    loop(data.length): i =>
      val a = alpha(i / 3)
      val value = image.data(i / 3 * image.channels + colors(i % 3))
      data(i) = if a > 0f then value / a else value
    Image(image.width, image.height, Image.RgbNames, data, image.encoding, image.colorSpace)

  /** Pixels with a channel above `maxValue` are scaled down to it: their hue stays. Beside an
    * infinite channel, finite ones are black.
    */
  def clamped(image: Image, maxValue: Float): Image =
    val data = image.data.clone
    val n = image.channels
    loop(image.width * image.height): pixel =>
      var greatest = 0f
      loop(n)(c => greatest = Math.max(greatest, data(pixel * n + c)))
      if greatest > maxValue then
        loop(n): c =>
          val i = pixel * n + c
          data(i) = if data(i).isInfinite then Math.signum(data(i)) * maxValue
          else data(i) * (maxValue / greatest)
    withData(image, data)

  /** Upside down. */
  def flipped(image: Image): Image =
    val row = image.width * image.channels
    val data = new Array[Float](image.data.length)
    loop(image.height): y =>
      System.arraycopy(image.data, y * row, data, (image.height - 1 - y) * row, row)
    withData(image, data)

  /** The same colours by other primaries, those of layers too.
    *
    * @throws ImageError if the image has no R, G and B
    */
  def inColorSpace(image: Image, space: ColorSpace): Image =
    val layers = image.channelNames.filter(n => n == "R" || n.endsWith(".R")).map(_.dropRight(1))
    val colors = layers.flatMap(layer => image.indicesOf(Image.RgbNames.map(layer + _)))
    if colors.isEmpty then
      throw ImageError(Code.ImageEdit, "only images with R, G and B have a colour space")
    val matrix = space.ofSrgb * image.colorSpace.toSrgb
    val data = image.data.clone
    for case Vector(r, g, b) <- colors do
      loop(image.width * image.height): pixel =>
        val offset = pixel * image.channels
        val c = matrix * Rgb(data(offset + r), data(offset + g), data(offset + b))
        data(offset + r) = c.r
        data(offset + g) = c.g
        data(offset + b) = c.b
    Image(image.width, image.height, image.channelNames, data, image.encoding, space)

  /** Mean of images of one size with the same channels, in double precision.
    *
    * @throws ImageError if they differ
    */
  def mean(images: Iterator[(String, Image)]): Image =
    val (firstName, first) = images.next()
    val sum = first.data.map(_.toDouble)
    var count = 1
    for (name, image) <- images do
      def differs(property: String) =
        throw ImageError(Code.ImageEdit, s"$name and $firstName differ in $property")
      if image.width != first.width || image.height != first.height then differs("size")
      if image.channelNames != first.channelNames then differs("their channels")
      if image.colorSpace ne first.colorSpace then differs("their colour space")
      loop(sum.length)(i => sum(i) += image.data(i))
      count += 1
    withData(first, sum.map(s => (s / count).toFloat))

  private def withData(image: Image, data: Array[Float]): Image =
    Image(image.width, image.height, image.channelNames, data, image.encoding, image.colorSpace)
