package candela.cli

import candela.base.{Problem, SceneError, Severity}
import candela.image.ImageFiles

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
    if !paths.exists(OutputFiles.extension(_) == "exr") then
      val message = s"only .exr files hold layers; `${paths.head}` does not"
      throw SceneError(Problem.general(message, Some("--outfile FILE.exr writes them")))

object OutputFiles:

  /** Exactly the files that were asked for. */
  def asked(names: Vector[String]): OutputFiles =
    OutputFiles(names.map(path).distinct, Vector.empty)

  /** As the scene's Film says, relative to the current folder. An EXR gets a PNG beside it, to look
    * at. What Candela does not write (pbrt does .tga and .pfm) becomes an EXR.
    */
  def ofFilm(filename: String): OutputFiles =
    val named = path(filename)
    if extension(named) == "exr" then
      OutputFiles(Vector(named, withExtension(named, "png")), Vector.empty)
    else if ImageFiles.isWritable(named) then OutputFiles(Vector(named), Vector.empty)
    else
      val exr = withExtension(named, "exr")
      val message =
        s"the scene's image `$filename` is neither .exr nor .png; it is written as `$exr`"
      val warning = Problem(Severity.Warning, None, message)
      OutputFiles(Vector(exr, withExtension(exr, "png")), Vector(warning))

  /** The name as a path. */
  def path(name: String): Path =
    try Path.of(name)
    catch
      case e: InvalidPathException =>
        throw SceneError(Problem.general(s"`$name` is no file name: ${e.getReason}"))

  private def problem(path: Path): Option[Problem] =
    val folder = Option(path.toAbsolutePath.getParent)
    val elsewhere = Some("--outfile FILE writes the image elsewhere")
    if !ImageFiles.isWritable(path) then
      Some(Problem.general(s"can't write `$path`", Some("images are written as .exr or .png")))
    else if Files.isDirectory(path) then
      Some(Problem.general(s"can't write the image `$path`: it is a folder", elsewhere))
    else if !folder.exists(Files.isDirectory(_)) then
      val missing = folder.getOrElse(path)
      Some(Problem.general(s"can't write `$path`: there is no folder `$missing`", elsewhere))
    else if !folder.exists(Files.isWritable) then
      Some(Problem.general(s"can't write `$path`: its folder is write-protected", elsewhere))
    else None

  private def extension(path: Path): String =
    val name = path.getFileName.toString
    name.drop(name.lastIndexOf('.') + 1).toLowerCase(java.util.Locale.ROOT)

  /** Replaces what follows the last dot, if there is one. */
  private def withExtension(path: Path, extension: String): Path =
    val name = path.getFileName.toString
    val dot = name.lastIndexOf('.')
    path.resolveSibling(s"${if dot > 0 then name.take(dot) else name}.$extension")
