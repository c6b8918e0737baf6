package candela.image

import candela.base.loop
import candela.color.Rgb

/** How files of channels hold the colours of a rendering. */
enum PixelFormat(val word: String, names: String):
  case Colors extends PixelFormat("rgb", "RGB")

  /** CIE 1931's Y. */
  case Luminance extends PixelFormat("luminance", "Y")

  /** CIE 1931's X, Y and Z. */
  case Tristimulus extends PixelFormat("xyz", "XYZ")

  /** An image with R, G and B, with these channels in their place. */
  def apply(image: Image): Image = if this == Colors then image else inXyz(image)

  private def inXyz(image: Image): Image =
    val Vector(r, g, b) = image.colorChannels: @unchecked
    val otherChannels = image.channelNames.indices.filterNot(Set(r, g, b)).toArray
    // That of depths is Z, too
    val otherNames = otherChannels.map(image.channelNames).map: name =>
      if names.contains(name) then s"Depth.$name" else name
    val channels = names.map(_.toString).toVector ++ otherNames
    val toXyz = image.colorSpace.xyzOfRgb
    val data = new Array[Float](image.width * image.height * channels.size)
    loop(image.width * image.height): pixel =>
      val (from, to) = (pixel * image.channels, pixel * channels.size)
      val xyz = toXyz * Rgb(image.data(from + r), image.data(from + g), image.data(from + b))
      if this == Luminance then data(to) = xyz.g
      else
        data(to) = xyz.r
        data(to + 1) = xyz.g
        data(to + 2) = xyz.b
      loop(otherChannels.length): k =>
        data(to + names.length + k) = image.data(from + otherChannels(k))
    Image(image.width, image.height, channels, data)

object PixelFormat:
  private val Xyz = Vector("X", "Y", "Z")

  /** An image with R, G and B in place of channels of CIE 1931's X, Y and Z, if it has those. */
  def colors(image: Image): Image = image.indicesOf(Xyz) match
    case Some(indices) if image.indicesOf(Image.RgbNames).isEmpty =>
      val names = image.channelNames.map: name =>
        if Xyz.contains(name) then Image.RgbNames(Xyz.indexOf(name)) else name
      val toRgb = image.colorSpace.rgbOfXyz
      val data = image.data.clone
      loop(image.width * image.height): pixel =>
        val at = pixel * image.channels
        def value(i: Int) = image.data(at + indices(i))
        val color = toRgb * Rgb(value(0), value(1), value(2))
        data(at + indices(0)) = color.r
        data(at + indices(1)) = color.g
        data(at + indices(2)) = color.b
      Image(image.width, image.height, names, data, image.encoding, image.colorSpace)
    case _ => image
