package candela.cli.rendering

import candela.base.{Problem, Version}
import candela.cli.files.{Denoising, OutputFiles, Sequence}
import candela.cli.options.Options
import candela.cli.terminal.{Figures, Report}
import candela.film.{PixelBounds, SpectralBands}
import candela.image.*
import candela.job.{FilmHeaders, Prepared}
import candela.render.Rendering

import java.nio.file.{Files, Path}

import scala.util.{Failure, Success, Try}

/** Writes the images of a rendering, in all formats that were asked for.
  *
  * @param name  of the scene, as users named it
  * @param paths image files
  */
private[cli] final class ImageWriter(
    options: Options,
    report: Report,
    denoising: Option[Denoising],
    val name: String,
    prepared: Prepared,
    val paths: Vector[Path]
):
  private val plan = prepared.plan
  private val output = options.settings.output

  /** The digest of the rendering, if what is done is to be skipped. */
  val digest: Option[String] = Option.when(options.film.skipDone):
    val header =
      FilmHeaders.of(options.settings, name, prepared, Path.of("film"), paths, options.film.shard)
    FilmHeaders.digest(header, options.settings.goal)

  /** Whether all images are there, of this very rendering. */
  def isDone: Boolean = digest.exists(Sequence.isDone(paths, _))

  /** The image, denoised too if asked. */
  def image(rendering: Rendering): Image =
    val noisy = rendering.image(plan.development)
    denoising.fold(noisy)(_(noisy))

  /** An image without samples must not replace another one. */
  def writable(rendering: Rendering): Vector[Path] =
    if rendering.samplesDone > 0 || rendering.isComplete then paths
    else paths.filterNot(Files.isRegularFile(_))

  /** Writes every file that can be written; returns those written. Viewers may ask for it, too. */
  def write(wanted: Vector[Path], rendering: Rendering, image: Image): Vector[Path] = synchronized:
    val alpha = OutputFiles.alpha(plan, image)
    val about = facts ++ digest.filter(_ => rendering.isComplete).map(Sequence.Digest -> _) ++
      taken(rendering)
    val how = WriteOptions(
      plan.development.isHalf,
      precisions,
      output.display,
      window,
      alpha
    )
    def write(path: Path) = Try:
      val (written, more) = OutputFiles.picture(path, image, alpha) match
        case Some(picture) => (picture, output.display.describe(picture))
        case None => (image, plan.layers.fold(Vector.empty)(_.metadata(image)))
      ImageFiles.write(path, written, about ++ more, how)
    // Those that can't hold the digest first: what is done is told by the others
    val order = wanted.sortBy(Sequence.keepsDigest)
    val attempts = order.map(path => path -> write(path)).sortBy((path, _) => wanted.indexOf(path))
    val failures = attempts.collect:
      case (_, Failure(e: ImageError)) => Problem.general(e.getMessage)
      case (_, Failure(e)) => throw e
    if failures.nonEmpty then
      val _ = report.errors(failures)
    attempts.collect { case (path, Success(_)) => path }

  /** What does not depend on the samples. */
  private def facts: Vector[(String, String)] =
    val PixelBounds(x0, y0, x1, y1) = plan.crop
    val crop = Option.when(isCropped):
      "crop" -> s"x $x0 to $x1, y $y0 to $y1 of ${plan.width}x${plan.height}"
    Vector(
      "software" -> s"Candela ${Version.current}",
      "scene" -> name,
      "dialect" -> prepared.description.dialect.toString.toLowerCase,
      "seed" -> options.settings.seed.toString
    ) ++ plan.features.filter(_._1 == "integrator") ++ crop ++
      plan.development.bands.fold(Vector.empty)(_ => SpectralBands.metadata)

  /** Which samples the image has, and what was done to them. */
  private def taken(rendering: Rendering): Vector[(String, String)] =
    val time = Option.when(output.storeTime):
      "renderSeconds" -> Figures.fixed(rendering.seconds, 2)
    // Those of earlier runs took no part of the time
    val earlier = Option.when(output.storeTime && rendering.earlier > 0):
      "samplesPerPixelOfEarlierRuns" -> rendering.earlier.toString
    Vector("samplesPerPixel" -> rendering.samplesDone.toString) ++ time ++ earlier ++
      Bias.metadata(plan, rendering, denoising)

  /** Channels whose layers have another precision than the image: whether it is half. */
  private def precisions: Map[String, Boolean] =
    val all =
      for
        layers <- plan.layers.toVector
        own = layers.layers.filter(_.needsFloat).map(_ -> false)
        (layer, isHalf) <- own ++ output.precisions
        channel <- layers.channels(layer)
      yield channel -> isHalf
    all.toMap

  private def isCropped: Boolean = plan.crop != PixelBounds(0, 0, plan.width, plan.height)

  private def window: Option[ImageWindow] = Option.when(isCropped):
    ImageWindow(plan.crop.x0, plan.crop.y0, plan.width, plan.height)
