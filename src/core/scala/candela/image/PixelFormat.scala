package candela.image

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
    val colors = image.colorChannels
    val otherChannels = image.channelNames.indices.filterNot(colors.contains)
    val rows = names.map("XYZ".indexOf(_))
    val toXyz = image.colorSpace.xyzOfRgb
    val values =
      for
        pixel <- Iterator.range(0, image.width * image.height)
        at = pixel * image.channels
        Vector(r, g, b) = colors.map(c => image.data(at + c)): @unchecked
        xyz = toXyz * Rgb(r, g, b)
        value <-
          rows.map(Vector(xyz.r, xyz.g, xyz.b)(_)) ++ otherChannels.map(c => image.data(at + c))
      yield value
    val channels = names.map(_.toString).toVector ++ otherChannels.map(image.channelNames)
    Image(image.width, image.height, channels, values.toArray)
