package candela.cli.rendering

import candela.diagnostics.Code
import candela.cli.files.{OutputFiles, Sequence}
import candela.cli.options.Options
import candela.cli.terminal.Report
import candela.image.{Contents, Image, OutputFormat}
import candela.job.{Denoising, EmptyImage, FilmHeaders, ImageFile, Prepared, Render, StrategyFiles}
import candela.render.Rendering

import java.nio.file.{Files, Path}

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
  private val files = ImageFile(options.settings, name, prepared)
  private val strategies = StrategyFiles(prepared.plan)

  /** The digest of the rendering, if what is done is to be skipped. */
  val digest: Option[String] = Option.when(options.film.skipDone):
    val header =
      FilmHeaders.of(options.settings, name, prepared, Path.of("film"), paths, options.film.shard)
    FilmHeaders.digest(header, options.settings.goal)

  /** Whether all images are there, of this very rendering. */
  def isDone: Boolean = digest.exists(Sequence.isDone(paths, _))

  /** The image, denoised too if asked. */
  def image(rendering: Rendering): Image = Render.develop(prepared, rendering, denoising)

  /** Warns of an image that shows nothing. */
  def warnIfEmpty(rendering: Rendering, image: Image): Unit =
    val isForeseen = prepared.warnings.exists(_.code == Code.EmptyView) ||
      prepared.description.warnings.exists(_.code == Code.DarkScene)
    val isPicture = paths.nonEmpty &&
      paths.forall(OutputFormat.of(_).exists(_.contents == Contents.Display))
    val problem = EmptyImage.problem(prepared, rendering, image, isForeseen, isPicture)
    report.warnings(problem.toVector, all = true)

  /** An image without samples must not replace another one. */
  def writable(rendering: Rendering): Vector[Path] =
    if rendering.samplesDone > 0 then paths
    else paths.filterNot(Files.isRegularFile(_))

  /** Writes every file that can be written; returns those written. Viewers may ask for it, too. */
  def write(wanted: Vector[Path], rendering: Rendering, image: Image): Vector[Path] = synchronized:
    val about = digest.filter(_ => rendering.isComplete).map(Sequence.Digest -> _).toVector
    // Those that can't hold the digest first: what is done is told by the others
    val failures = OutputFiles.failures(wanted.sortBy(Sequence.keepsDigest)): path =>
      val contents = strategies.contents(path, image)
      files.encoded(path, contents, rendering, about, denoising.map(_.describe)).save()
    if failures.nonEmpty then
      val _ = report.errors(failures.sortBy((path, _) => wanted.indexOf(path)).map(_._2))
    wanted.diff(failures.map(_._1))
