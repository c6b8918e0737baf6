package candela.job

import candela.base.Version
import candela.film.{Fireflies, PixelBounds, SpectralBands}
import candela.image.{
  Contents, EncodedImage, Image, ImageEdits, ImageFiles, ImageWindow, OutputFormat, WriteOptions
}
import candela.render.{Rendering, RenderPlan}
import candela.settings.RenderSettings

import java.nio.file.Path
import java.util.Locale

/** Image files of a rendering, with what they say of it.
  *
  * @param name of the scene, as users named it
  */
final class ImageFile(settings: RenderSettings, name: String, prepared: Prepared):
  private val plan = prepared.plan
  private val output = settings.output

  /** An image in the format of its file.
    *
    * @param more     to say of it
    * @param denoiser that made the denoised colours, if there are any
    */
  def encoded(
      path: Path,
      image: Image,
      rendering: Rendering,
      more: Vector[(String, String)] = Vector.empty,
      denoiser: Option[String] = None
  ): EncodedImage =
    val about = facts ++ more ++ sampleFacts(rendering) ++ ImageFile.bias(plan, rendering, denoiser)
    val writeOptions = WriteOptions(
      plan.development.isHalf,
      precisions,
      output.display,
      window,
      pool = prepared.pool
    )
    val (written, last) =
      if ImageFile.holds(path, Contents.Display) then (image, Vector.empty)
      else (ImageFile.file(path, image, plan), plan.layers.fold(Vector.empty)(_.metadata(image)))
    ImageFile.encoded(path, written, about ++ last, writeOptions)

  /** Writes a mean of renderings with its error, in the precision of its values.
    *
    * @param rendering with the samples of all
    * @param more      to say of it
    */
  def writeReference(
      path: Path,
      image: Image,
      rendering: Rendering,
      more: Vector[(String, String)]
  ): Unit =
    val writeOptions = WriteOptions(window = window, pool = prepared.pool)
    ImageFiles.write(path, image, facts ++ sampleFacts(rendering) ++ more, writeOptions)

  /** What does not depend on the samples. */
  private def facts: Vector[(String, String)] =
    val PixelBounds(x0, y0, x1, y1) = plan.crop
    val crop = Option.when(isCropped):
      "crop" -> s"x $x0 to $x1, y $y0 to $y1 of ${plan.width}x${plan.height}"
    Vector(
      "software" -> s"Candela ${Version.current}",
      // Wherever it is: the image is the same
      "scene" -> ImageFile.withoutFolder(name),
      "dialect" -> prepared.description.dialect.toString.toLowerCase(Locale.ROOT),
      "seed" -> settings.seed.toString
    ) ++ plan.features.filter(_._1 == "integrator") ++ crop ++
      plan.development.bands.fold(Vector.empty)(_ => SpectralBands.metadata)

  /** Which samples the image has. */
  private def sampleFacts(rendering: Rendering): Vector[(String, String)] =
    val time = Option.when(output.storeTime):
      "renderSeconds" -> ImageFile.hundredths(rendering.seconds)
    // Those of earlier runs took no part of the time
    val earlier = Option.when(output.storeTime && rendering.earlier > 0):
      "samplesPerPixelOfEarlierRuns" -> rendering.earlier.toString
    Vector("samplesPerPixel" -> rendering.samplesDone.toString) ++ time ++ earlier

  /** Channels whose layers have another precision than the image: whether it is half. */
  private def precisions: Map[String, Boolean] =
    val channelPrecisions =
      for
        layers <- plan.layers.toVector
        own = layers.layers.filter(_.needsFloat).map(_ -> false)
        (layer, isHalf) <- own ++ output.precisions
        channel <- layers.channels(layer)
      yield channel -> isHalf
    channelPrecisions.toMap

  private def isCropped: Boolean = plan.crop != PixelBounds(0, 0, plan.width, plan.height)

  private def window: Option[ImageWindow] = Option.when(isCropped):
    ImageWindow(plan.crop.x0, plan.crop.y0, plan.width, plan.height)

object ImageFile:

  /** An image in the format of its file, whose colours are multiplied by alpha, if it has that. A
    * picture shows the denoised colours, if there are any, and alpha if its format keeps it.
    */
  def encoded(
      path: Path,
      image: Image,
      about: Vector[(String, String)] = Vector.empty,
      options: WriteOptions = WriteOptions()
  ): EncodedImage =
    if holds(path, Contents.Display) then
      val opaque = Denoising.displayed(image)
      val opacity = alpha(image).filter(_ => OutputFormat.of(path).exists(_.keepsAlpha))
      val picture = opacity.fold(opaque)(ImageEdits.divided(opaque, _))
      val display = options.display.describe(picture)
      ImageFiles.encoded(path, picture, about ++ display, options.copy(alpha = opacity))
    else ImageFiles.encoded(path, image, about, options)

  private def holds(path: Path, contents: Contents): Boolean =
    OutputFormat.of(path).exists(_.contents == contents)

  private def withoutFolder(name: String): String =
    name.drop(name.lastIndexWhere(c => c == '/' || c == java.io.File.separatorChar) + 1)

  /** The opacity of each pixel, if it is a layer of an image with colours. */
  private def alpha(image: Image): Option[Array[Float]] =
    val channel = image.channelNames.indexOf("A")
    Option.when(channel >= 0 && image.channels > 1):
      Array.tabulate(image.width * image.height)(i => image.data(i * image.channels + channel))

  /** What a file of channels holds. */
  private def file(path: Path, image: Image, plan: RenderPlan): Image =
    if holds(path, Contents.Radiance) then image
    else plan.development.format(image)

  /** What makes the image biased: what was done, and the channels that it biased. */
  private def bias(
      plan: RenderPlan,
      rendering: Rendering,
      denoiser: Option[String]
  ): Vector[(String, String)] =
    val changed = fireflies(plan, rendering)
    val channels =
      changed.orElse(plan.method.bias).toVector.flatMap(_ => Image.RgbNames) ++
        denoiser.toVector.flatMap(_ => Denoising.Channels)
    changed.map("fireflies" -> _).toVector ++
      plan.method.bias.orElse(plan.method.addedLight).map("caustics" -> _) ++
      denoiser.map("denoiser" -> _) ++
      Option.when(channels.nonEmpty)("biased" -> channels.mkString(", "))

  /** What was done about fireflies, if anything. */
  def fireflies(plan: RenderPlan, rendering: Rendering): Option[String] = plan.fireflies match
    case Fireflies.Kept => None
    case Fireflies.Reweighted =>
      val lossPercent = hundredths(100 * rendering.film.leftOut)
      Some(s"re-weighted (Zirr, Hanika, Dachsbacher 2018), $lossPercent % of the light left out")
    case Fireflies.Clamped(most) => Some(s"indirect light of samples limited to $most")

  private def hundredths(value: Double): String = "%.2f".formatLocal(Locale.ROOT, value)
