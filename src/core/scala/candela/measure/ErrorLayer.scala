package candela.measure

import candela.base.loop
import candela.image.{Image, ImageEdits}

/** A reference's own expected squared errors, averaged as the metrics are. */
final case class OwnError(mse: Double, relativeMse: Double)

/** The layer in which a reference holds its own error: the estimated mean squared error of each of
  * its values, which is their variance. RenderMan's layer `mse` has the same name and meaning.
  */
object ErrorLayer:
  val Name = "mse"
  val Channels: Vector[String] = Image.RgbNames.map(c => s"$Name.$c")

  /** Linear sRGB, and the layer if there is one. */
  def extract(image: Image): Image = of(image).fold(image.toRgb)(append(image.toRgb, _))

  /** Three colours and their errors. */
  def append(colors: Image, errors: Image): Image =
    val data = new Array[Float](2 * colors.data.length)
    loop(data.length): i =>
      val index = i / 6 * 3 + i % 3
      data(i) = if i % 6 < 3 then colors.data(index) else errors.data(index)
    Image(colors.width, colors.height, colors.channelNames ++ Channels, data)

  /** The variances of R, G and B, if the image has them. */
  def of(image: Image): Option[Image] =
    Option.when(Channels.forall(image.channelNames.contains)):
      val layer = ImageEdits.select(image, Channels)
      Image(image.width, image.height, Image.RgbNames, layer.data)

  /** The own error of a reference, if it has the layer: the MSE and the relative MSE that an image
    * without error would have against it.
    */
  def error(reference: Image): Option[OwnError] = of(reference).map: variance =>
    val colors = reference.toRgb
    var absolute, relative = 0.0
    var count = 0
    loop(variance.data.length): i =>
      val scale = colors.data(i) + Metrics.RelativeEpsilon
      val square = variance.data(i).toDouble
      if java.lang.Double.isFinite(square / (scale * scale)) then
        absolute += square
        relative += square / (scale * scale)
        count += 1
    OwnError(absolute / Math.max(1, count), relative / Math.max(1, count))
