package candela.cli

import candela.base.{FileName, Problem, SceneError, Severity}
import candela.image.{Contents, OutputFormat}
import candela.render.RenderPlan

import java.nio.file.{Files, InvalidPathException, Path}

/** Output files of an image, one per format, and the warnings about them. */
final case class OutputFiles(paths: Vector[Path], warnings: Vector[Problem]):

  /** Verifies before rendering that the files can be written.
    *
    * @throws SceneError if one can't
    */
  def check(): Unit =
    val problems = paths.flatMap(OutputFiles.problem)
    if problems.nonEmpty then throw SceneError(problems)

  /** @throws SceneError if no file can store AOVs */
  def checkLayers(): Unit =
    if !paths.flatMap(OutputFormat.of).exists(_.contents == Contents.Channels) then
      val suffixes = OutputFormat.listed(Contents.Channels)
      val message = s"AOVs need $suffixes output, found `${paths.head}`"
      val help = s"--outfile FILE.${OutputFormat.default.suffix} stores them"
      throw SceneError(Problem.general(message, Some(help)))

object OutputFiles:

  /** Whether a file must store layers; those that only guide the denoiser need none. */
  def needLayers(plan: RenderPlan, denoises: Boolean): Boolean =
    val guides = if denoises then Denoising.Layers else Vector.empty
    plan.layers.exists(_.layers.diff(guides).nonEmpty) || plan.development.bands.nonEmpty

  /** Exactly the requested images. */
  def asked(names: Vector[String]): OutputFiles =
    OutputFiles(names.filterNot(FilmOptions.isFilm).map(path).distinct, Vector.empty)

  /** The file named by the scene's Film, relative to the current folder, plus a preview if its
    * format can't be displayed. Formats that Candela doesn't write (pbrt has more) are replaced by
    * the default.
    */
  def ofFilm(filename: String): OutputFiles =
    val named = path(filename)
    OutputFormat.of(named) match
      case Some(format) if format.contents == Contents.Display =>
        OutputFiles(Vector(named), Vector.empty)
      case Some(_) => OutputFiles(withPreview(named), Vector.empty)
      case None =>
        val written = FileName.withSuffix(named, OutputFormat.default.suffix)
        val message = s"`$filename` is not ${OutputFormat.listed()}; " +
          s"writing `$written`"
        OutputFiles(withPreview(written), Vector(Problem(Severity.Warning, None, message)))

  private def withPreview(path: Path): Vector[Path] =
    Vector(path, FileName.withSuffix(path, OutputFormat.preview.suffix))

  /** `name` as a path. */
  def path(name: String): Path =
    try Path.of(name)
    catch
      case e: InvalidPathException =>
        throw SceneError(Problem.general(s"`$name` is not a valid file name: ${e.getReason}"))

  private def problem(path: Path): Option[Problem] =
    val folder = Option(path.toAbsolutePath.getParent)
    val elsewhere = Some("choose another file with --outfile FILE")
    if OutputFormat.of(path).isEmpty then
      val help = s"supported formats: ${OutputFormat.listed()}"
      Some(Problem.general(s"can't write `$path`", Some(help)))
    else if Files.isDirectory(path) then
      Some(Problem.general(s"can't write the image `$path`: it is a folder", elsewhere))
    else if !folder.exists(Files.isDirectory(_)) then
      val missing = folder.getOrElse(path)
      Some(Problem.general(s"can't write `$path`: no such folder: `$missing`", elsewhere))
    else if !folder.exists(Files.isWritable) then
      Some(Problem.general(s"can't write `$path`: no write permission in its folder", elsewhere))
    else None
