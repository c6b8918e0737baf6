package candela.image

import candela.base.loop
import candela.color.{Encoding, Srgb}
import candela.math.clamp
import candela.sampling.SampleHash

import java.awt.color.ColorSpace
import java.awt.image.{BufferedImage, ComponentColorModel, DataBuffer, Raster}
import java.awt.Transparency

/** Display-referred images of 8 or 16 bits, sRGB-encoded: clamped to [0, 1], NaN black. */
private[image] object Bitmap:

  /** Luminance alone is written as grey, but with alpha as three channels. */
  def of(
      image: Image,
      display: DisplayTransform,
      alpha: Option[Array[Float]] = None
  ): BufferedImage =
    val displayed = display(image)
    val isGray = displayed.indicesOf(Image.RgbNames).isEmpty && alpha.isEmpty
    val colors = displayed.colorChannels
    val sources = (if isGray then colors.take(1) else colors).toArray
    val straight = alpha.orNull
    val picture = empty(displayed.width, displayed.height, isGray, alpha.isDefined, display.bits)
    val bands = picture.getRaster.getNumBands
    val codes = new Array[Int](bands * displayed.width)
    val maxCode = ((1 << display.bits) - 1).toFloat
    val dithers = display.dithers && display.bits == 8
    loop(displayed.height): y =>
      loop(displayed.width): x =>
        loop(sources.length): c =>
          val value = encoded(displayed(x, y, sources(c)), displayed.encoding)
          val round = if dithers then threshold(x, y, c) else 0.5f
          codes(x * bands + c) = (value * maxCode + round).toInt
        if straight != null then
          val a = clamp(straight(y * displayed.width + x), 0f, 1f)
          codes(x * bands + 3) = (a * maxCode + 0.5f).toInt
      picture.getRaster.setPixels(0, y, displayed.width, 1, codes)
    picture

  private def encoded(value: Float, encoding: Encoding): Float =
    val code = if encoding == Encoding.Srgb then value else Srgb.encode(encoding.decode(value))
    if code > 0f then Math.min(code, 1f) else 0f

  /** Uniform in [0, 1), so that the expected code is the exact value, and codes that are whole
    * numbers stay.
    *
    * Source: Roberts, "Picture Coding Using Pseudo-Random Noise", IRE Transactions on Information
    * Theory 8(2), 1962.
    */
  private def threshold(x: Int, y: Int, channel: Int): Float =
    SampleHash.toUnit((SampleHash.pixel(x, y, channel) >>> 32).toInt)

  private def empty(
      width: Int,
      height: Int,
      isGray: Boolean,
      hasAlpha: Boolean,
      bits: Int
  ): BufferedImage =
    if bits == 8 then
      val kind =
        if isGray then BufferedImage.TYPE_BYTE_GRAY
        else if hasAlpha then BufferedImage.TYPE_INT_ARGB
        else BufferedImage.TYPE_INT_RGB
      BufferedImage(width, height, kind)
    else if isGray then BufferedImage(width, height, BufferedImage.TYPE_USHORT_GRAY)
    else
      val space = ColorSpace.getInstance(ColorSpace.CS_sRGB)
      val kind = DataBuffer.TYPE_USHORT
      val (bands, clarity) =
        if hasAlpha then (4, Transparency.TRANSLUCENT) else (3, Transparency.OPAQUE)
      val model = ComponentColorModel(space, hasAlpha, false, clarity, kind)
      val raster = Raster.createInterleavedRaster(kind, width, height, bands, null)
      BufferedImage(model, raster, false, null)
