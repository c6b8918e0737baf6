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
    val channels = names.map(_.toString).toVector ++ otherChannels.map(image.channelNames)
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
