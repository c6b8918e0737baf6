package candela.job

import candela.aov.Layer
import candela.image.{Image, Oidn}

/** Adds a denoised image beside the noisy one.
  *
  * @param denoiser the library
  */
final class Denoising(denoiser: Oidn, threads: Int):
  import Denoising.*

  /** The image with a layer of denoised colours behind the others. */
  def apply(image: Image): Image =
    def guide(layer: Layer) =
      image.indicesOf(layer.channels).map(image.selected)
    val noisy = image.selected(image.colorChannels)
    val (albedo, normal) = (guide(Layer.DenoisingAlbedo), guide(Layer.DenoisingNormal))
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

object Denoising:
  /** Its result. */
  val Channels: Vector[String] = Vector("Denoised.R", "Denoised.G", "Denoised.B")

  /** What pictures show: the denoised colours, if there are any. */
  def displayed(image: Image): Image =
    image.indicesOf(Channels).fold(image)(image.selected)
