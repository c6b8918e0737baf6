package candela.cli.files

import candela.diagnostics.Problem
import candela.io.FileName
import candela.cli.options.{FilmOptions, Options}
import candela.cli.terminal.Report
import candela.job.{FilmHeaders, FilmKeeper, Prepared}
import candela.render.storage.{FilmFile, FilmLock}

import java.nio.file.Path

/** Which film file a rendering of the command line keeps. */
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
  ): Option[FilmKeeper] =
    for path <- path(options, outfiles, images, resumed) yield
      val shard = options.film.shard
      val header = FilmHeaders.of(options.settings, scene, loaded, path, images, shard)
      def warn(problem: Problem) = report.warnings(Vector(problem), all = true)
      val keeperOptions = FilmKeeper.How(options.film.every, warn)
      resumed match
        case Some(film) => FilmKeeper.resumed(film, header, loaded.plan, keeperOptions)
        case None => FilmKeeper.of(path, header, keeperOptions)(locked(path))

  /** @throws SceneError if another rendering writes this film file */
  def locked(path: Path): FilmLock =
    FileRegister().check(Output.film(path, path.toString))
    FilmKeeper.locked(path)
