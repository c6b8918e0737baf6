package candela.image

import candela.base.loop
import candela.color.{Encoding, Gamut, Magma, Rgb, ToneCurve}

import java.util.Locale

/** Scale of the light before its tone curve. */
enum Exposure:
  /** Powers of two. */
  case Stops(value: Float)

  /** The image's geometric mean luminance becomes middle grey; black pixels don't count.
    *
    * Source: Reinhard et al., "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002,
    * §2, with key 0.18.
    */
  case Auto

/** How linear light becomes a picture: only display formats use it.
  *
  * @param falseColor whether to show luminance in stops instead of colours
  * @param bits       8 or 16 bits per channel, if the format supports both
  * @param dithers    whether 8-bit values are rounded at random, which hides banding
  */
final case class DisplayTransform(
    curve: ToneCurve = ToneCurve.Linear,
    exposure: Exposure = Exposure.Stops(0f),
    falseColor: Boolean = false,
    bits: Int = 8,
    dithers: Boolean = false
):
  /** Whether colours are stored as they are. */
  def isPlain: Boolean =
    curve == ToneCurve.Linear && exposure == Exposure.Stops(0f) && !falseColor

  /** Display-referred colours. */
  def apply(image: Image): Image =
    if isPlain then DisplayTransform.displayable(image)
    else
      val light = DisplayTransform.displayable(image.toRgb)
      val scale = scaleOf(light)
      val data = new Array[Float](light.data.length)
      loop(light.width * light.height): pixel =>
        val offset = 3 * pixel
        val c = Rgb(light.data(offset), light.data(offset + 1), light.data(offset + 2)) * scale
        if falseColor then
          val stops = Math.log(c.luminance / DisplayTransform.Grey) / Math.log(2)
          val position = (stops / DisplayTransform.Stops + 1) / 2
          loop(3)(i => data(offset + i) = Magma(if position.isNaN then 0 else position, i))
        else
          val displayed = curve(c)
          data(offset) = displayed.r
          data(offset + 1) = displayed.g
          data(offset + 2) = displayed.b
      val encoding = if falseColor then Encoding.Srgb else Encoding.Linear
      Image(light.width, light.height, Image.RgbNames, data, encoding)

  /** The transform, as metadata of the picture. */
  def describe(image: Image): Vector[(String, String)] =
    if isPlain then Vector.empty
    else
      val stops = Math.log(scaleOf(image.toRgb).toDouble) / Math.log(2)
      val range =
        "luminance from -%1$.0f to %1$.0f".formatLocal(Locale.ROOT, DisplayTransform.Stops)
      Vector(
        "exposure" -> "%.2f stops".formatLocal(Locale.ROOT, stops),
        if falseColor then "falseColor" -> s"$range stops about ${DisplayTransform.Grey}"
        else "toneCurve" -> curve.word
      )

  private def scaleOf(light: Image): Float = exposure match
    case Exposure.Stops(value) => Math.pow(2, value.toDouble).toFloat
    case Exposure.Auto =>
      var sum = 0.0
      var count = 0
      loop(light.width * light.height): pixel =>
        val offset = 3 * pixel
        val y = Rgb(light.data(offset), light.data(offset + 1), light.data(offset + 2)).luminance
        if y > 0f && java.lang.Float.isFinite(y) then
          sum += Math.log(y.toDouble)
          count += 1
      if count == 0 then 1f else (DisplayTransform.Grey / Math.exp(sum / count)).toFloat

object DisplayTransform:
  /** Colours as they are, in 8 bits. */
  val Plain: DisplayTransform = DisplayTransform()

  /** Reflectance of a photographer's grey card. */
  val Grey = 0.18f

  /** In sRGB, without negative components; images without such colours are kept. */
  private def displayable(image: Image): Image =
    val isLight = image.encoding == Encoding.Linear && image.indicesOf(Image.RgbNames).isDefined
    if !isLight then image
    else
      val light = image.toRgb
      if light.data.exists(_ < 0f) then light.mapped(Gamut.desaturate)
      else if image.colorSpace.isSrgb then image
      else light

  /** Half the range of the false-colour view. */
  private val Stops = 6.0
