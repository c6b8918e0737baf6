package candela.cli.files

import candela.base.{FileName, Problem, SceneError, Severity}
import candela.cli.options.{FilmOptions, Options}
import candela.cli.terminal.Report
import candela.job.{FilmHeaders, Prepared}
import candela.render.storage.{Checkpoints, FilmFile, FilmHeader, FilmLock, FilmWriter}

import java.nio.file.{Files, Path}

/** The film file of one rendering, which no other rendering can write until it is closed.
  *
  * @param header of the rendering; its number of samples done is not used
  * @param start  the saved rendering to continue, if any
  */
private[cli] final class FilmKeeping(
    val path: Path,
    header: FilmHeader,
    val start: Option[FilmFile],
    mayEndEarly: Boolean,
    lock: Option[FilmLock],
    options: Options,
    report: Report
) extends AutoCloseable:
  def close(): Unit = lock.foreach(_.close())

  /** Whether there is nothing left to render. */
  def isDone: Boolean =
    !options.settings.isEndless && start.exists(f =>
      f.header.isComplete && f.header.samples == header.samples
    )

  /** Samples that every pixel has already. */
  def samplesDone: Int = start.fold(0)(_.header.done)

  /** @param isEnough whether the rendering ended because its goal was reached */
  def checkpointer(isEnough: () => Boolean): Checkpoints =
    def of(done: Int) =
      val isEarly = mayEndEarly && isEnough()
      val planned = if isEarly then Math.min(done, header.samples) else header.samples
      header.copy(done = done, samples = planned)
    // A damaged file must not replace its previous copy.
    val writer = FilmWriter(path, isGood = start.forall(_.damage.isEmpty))
    Checkpoints(writer, of, start, options.film.every, warn)

  private def warn(why: String): Unit =
    val message = s"can't write the film file `$path`: $why"
    report.warnings(Vector(Problem(Severity.Warning, None, message)), all = true)

private[cli] object FilmKeeping:

  /** The film file named on the command line. */
  def named(options: Options, outfiles: Vector[String]): Option[String] =
    outfiles.find(FilmOptions.isFilm).orElse(options.film.checkpoint.filter(_.nonEmpty))

  /** The film file to write, if one was asked for. */
  def path(
      options: Options,
      outfiles: Vector[String],
      images: Vector[Path],
      resumed: Option[FilmFile]
  ): Option[Path] =
    def beside = options.film.checkpoint.flatMap: _ =>
      images.headOption.map(FileName.withSuffix(_, FilmFile.Suffix))
    resumed.map(_.path)
      .orElse(named(options, outfiles).map(OutputFiles.path))
      .orElse(beside)

  /** The film file of a rendering, if one was asked for. An existing one is continued.
    *
    * @param outfiles as asked for
    * @param images   image files to write
    * @param resumed  the saved rendering of `resume`, which has locked its file
    * @throws SceneError if the file is of another rendering
    */
  def of(
      options: Options,
      report: Report,
      scene: String,
      loaded: Prepared,
      outfiles: Vector[String],
      images: Vector[Path],
      resumed: Option[FilmFile]
  ): Option[FilmKeeping] =
    for path <- path(options, outfiles, images, resumed) yield
      val now = FilmHeaders.of(options.settings, scene, loaded, path, images, options.film.shard)
      resumed match
        case Some(film) =>
          val obstacle = film.header.obstacle(loaded.plan)
          val next = continued(film, now, loaded.plan.samplesPerPixel, obstacle)
          FilmKeeping(path, next, resumed, obstacle.isEmpty, None, options, report)
        case None =>
          val lock = locked(path)
          try
            val start = existing(path, now, report)
            val mayEndEarly = now.obstacle(loaded.plan).isEmpty
            FilmKeeping(path, now, start, mayEndEarly, Some(lock), options, report)
          catch
            case e: Throwable =>
              lock.close()
              throw e

  /** @throws SceneError if another rendering writes this film file */
  def locked(path: Path): FilmLock =
    FileRegister().check(Output.film(path, path.toString))
    FilmLock.take(path).getOrElse:
      FilmInput.fail(s"`$path` is being written by another rendering", "wait for it, or stop it")

  /** The rendering that continues a saved one. */
  private def continued(
      film: FilmFile,
      now: FilmHeader,
      samples: Int,
      obstacle: Option[String]
  ): FilmHeader =
    FilmInput.verify(film, now.copy(count = film.header.count))
    val header = film.header
    if now.samples != header.samples then
      for why <- obstacle do
        FilmInput.fail(
          s"can't change the ${header.samples} samples per pixel of `${film.path}`: $why",
          "render with --spp N --checkpoint, N being the most you may want, and --time or --error"
        )
    if samples < header.done then
      FilmInput.fail(s"`${film.path}` has ${header.done} samples per pixel already")
    header.copy(samples = now.samples)

  /** The saved rendering at `path`, if there is one. */
  private def existing(path: Path, now: FilmHeader, report: Report): Option[FilmFile] =
    Option.when(Files.isRegularFile(path) || Files.exists(FilmFile.previous(path))):
      val film =
        try FilmInput.open(path.toString, report)
        catch case e: SceneError => FilmInput.fail(e.problems.head.message, Remove)
      for difference <- now.difference(film.header) do
        FilmInput.fail(s"`$path` is of another rendering: it has $difference", Remove)
      if film.header.shards != now.shards then
        FilmInput.fail(s"`$path` is of another shard: ${film.header.part}", Remove)
      film

  private val Remove = "remove it, or name another file"
