package candela.cli

import candela.base.{FileName, Problem, SceneError, Severity}
import candela.image.{Contents, OutputFormat}

import java.nio.file.{Files, InvalidPathException, Path}

/** Where an image goes: one file for each format; and what there is to say about that. */
final case class OutputFiles(paths: Vector[Path], warnings: Vector[Problem]):

  /** Looks, before hours of rendering, whether the files can be written.
    *
    * @throws SceneError if not
    */
  def check(): Unit =
    val problems = paths.flatMap(OutputFiles.problem)
    if problems.nonEmpty then throw SceneError(problems)

  /** @throws SceneError if no file can hold more than colours */
  def checkLayers(): Unit =
    if !paths.flatMap(OutputFormat.of).exists(_.contents == Contents.Channels) then
      val suffixes = OutputFormat.listed(Contents.Channels)
      val message = s"only $suffixes files hold layers; `${paths.head}` does not"
      val help = s"--outfile FILE.${OutputFormat.default.suffix} writes them"
      throw SceneError(Problem.general(message, Some(help)))

object OutputFiles:

  /** Exactly the files that were asked for. */
  def asked(names: Vector[String]): OutputFiles =
    OutputFiles(names.map(path).distinct, Vector.empty)

  /** As the scene's Film says, relative to the current folder, with a preview beside what can't be
    * displayed. Formats that Candela does not write (pbrt has more) become the default one.
    */
  def ofFilm(filename: String): OutputFiles =
    val named = path(filename)
    OutputFormat.of(named) match
      case Some(format) if format.contents == Contents.Display =>
        OutputFiles(Vector(named), Vector.empty)
      case Some(_) => OutputFiles(withPreview(named), Vector.empty)
      case None =>
        val written = FileName.withSuffix(named, OutputFormat.default.suffix)
        val message = s"the scene's image `$filename` is not ${OutputFormat.listed()}; " +
          s"it is written as `$written`"
        OutputFiles(withPreview(written), Vector(Problem(Severity.Warning, None, message)))

  private def withPreview(path: Path): Vector[Path] =
    Vector(path, FileName.withSuffix(path, OutputFormat.preview.suffix))

  /** The name as a path. */
  def path(name: String): Path =
    try Path.of(name)
    catch
      case e: InvalidPathException =>
        throw SceneError(Problem.general(s"`$name` is no file name: ${e.getReason}"))

  private def problem(path: Path): Option[Problem] =
    val folder = Option(path.toAbsolutePath.getParent)
    val elsewhere = Some("--outfile FILE writes the image elsewhere")
    if OutputFormat.of(path).isEmpty then
      val help = s"images are written as ${OutputFormat.listed()}"
      Some(Problem.general(s"can't write `$path`", Some(help)))
    else if Files.isDirectory(path) then
      Some(Problem.general(s"can't write the image `$path`: it is a folder", elsewhere))
    else if !folder.exists(Files.isDirectory(_)) then
      val missing = folder.getOrElse(path)
      Some(Problem.general(s"can't write `$path`: there is no folder `$missing`", elsewhere))
    else if !folder.exists(Files.isWritable) then
      Some(Problem.general(s"can't write `$path`: its folder is write-protected", elsewhere))
    else None
