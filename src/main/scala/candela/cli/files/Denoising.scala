package candela.cli.files

import candela.cli.terminal.Figures
import candela.image.{Image, Oidn}
import candela.layers.Layer
import candela.measure.Metrics

/** `candela render --denoise`: a denoised image beside the noisy one.
  *
  * @param denoiser the library
  */
private[candela] final class Denoising(denoiser: Oidn, threads: Int):
  import Denoising.*

  /** The image with a layer of denoised colours behind the others. */
  def apply(image: Image): Image =
    def found(layer: Layer) =
      image.indicesOf(layer.channels).map(image.selected)
    val noisy = image.selected(image.colorChannels)
    val (albedo, normal) = (found(Layer.DenoisingAlbedo), found(Layer.DenoisingNormal))
    val colors = denoiser.denoise(noisy, albedo, normal, threads)
    val names = image.channelNames ++ Channels
    val data = new Array[Float](names.size * image.width * image.height)
    for pixel <- 0 until image.width * image.height do
      System.arraycopy(
        image.data,
        image.channels * pixel,
        data,
        names.size * pixel,
        image.channels
      )
      System.arraycopy(colors.data, 3 * pixel, data, names.size * pixel + image.channels, 3)
    Image(image.width, image.height, names, data, colorSpace = image.colorSpace)

  /** For image files. */
  def describe: String =
    s"Open Image Denoise ${denoiser.version}, prefiltered albedo and normals"

/** A denoised image, and the time that denoising took.
  *
  * @param image with the noisy colours
  */
private[cli] final case class Denoised(image: Image, renderSeconds: Double, seconds: Double):

  /** Relative MSE of the noisy and of the denoised image; between them that of the noisy image if
    * the time had been spent on samples, whose error falls as 1/time.
    */
  def errors(reference: Image): String =
    def error(of: Image) = Metrics.compare(of, reference).relativeMse
    val noisy = error(image.toRgb)
    val atEqualTime = noisy * renderSeconds / (renderSeconds + seconds)
    val figures = Vector(noisy, atEqualTime, error(Denoising.shown(image).toRgb))
    val names = Vector("noisy", "noisy in the same time", "denoised")
    figures.map(Figures.scientific).zip(names).map((e, name) => s"$e $name").mkString(", ")

private[candela] object Denoising:
  /** Its result. */
  val Channels: Vector[String] = Vector("Denoised.R", "Denoised.G", "Denoised.B")

  /** What pictures show: the denoised colours, if there are any. */
  def shown(image: Image): Image =
    image.indicesOf(Channels).fold(image)(image.selected)
