package candela.cli.files

import candela.diagnostics.{Code, Problem, SceneError, SourcePos}
import candela.io.WholeFile
import candela.render.storage.FilmFile

import java.nio.file.attribute.BasicFileAttributes
import java.nio.file.{Files, Path}

import scala.util.Try

/** Files to write.
  *
  * @param kind        as messages name them: "image"
  * @param of          the input they belong to
  * @param option      that names them
  * @param beside      what is written with them, such as previous copies
  * @param pos         the parameter that names them, if a scene does
  * @param isAsked     whether the user has named them: pipes and devices, too
  * @param isRewritten whether they are written more than once, so that they are no pipes
  */
private[candela] final case class Output(
    files: Vector[Path],
    kind: String,
    of: String,
    option: String = "outfile",
    beside: Vector[Path] = Vector.empty,
    pos: Option[SourcePos] = None,
    isAsked: Boolean = true,
    isRewritten: Boolean = false
)

/** What a run reads and writes. The one place where outputs are checked, before the work begins:
  * each can be written, is no file that the run has read, and is written once.
  */
private[candela] final class FileRegister:
  import FileRegister.*
  private var inputs = Set.empty[AnyRef]
  private var outputs = Map.empty[Path, Output]
  private var room = Option.empty[Vector[Path]]

  /** From now on, files can be written in these folders only, or below them. */
  def confine(folders: Vector[Path]): Unit =
    room = Some(folders.flatMap(f => Try(f.toAbsolutePath.toRealPath()).toOption))

  def read(files: Iterable[Path]): Unit = inputs ++= files.flatMap(identities)

  def hasRead(file: Path): Boolean = identities(file).exists(inputs)

  /** Checks files that are to be written later.
    *
    * @throws SceneError if one can't be
    */
  def check(output: Output): Unit =
    def isInput(file: Path) = Option.when(hasRead(file)):
      val help = s"choose another name with --${output.option} FILE"
      Problem.general(
        Code.OutputConflict,
        s"`$file` is an input file; refusing to overwrite it",
        Some(help)
      )
    def problem(file: Path) = outside(file, output).orElse(irregular(file, output))
      .orElse(obstacle(file)).orElse(isInput(file))
      .orElse(WholeFile.refusal(file).map(unwritable(file, _)))
    val problems = output.files.flatMap(problem)
    if problems.nonEmpty then throw SceneError(problems)
    for first <- output.beside.flatMap(problem).headOption do throw SceneError(first)

  private def outside(file: Path, output: Output): Option[Problem] =
    for
      folders <- room
      if !canonical(file).exists(there => folders.exists(there.startsWith(_)))
      message = s"the ${output.kind} must be in the folder of the image, found `$file`"
    yield
      val help = Some("--sandbox allows output only in the folder of --outfile or of the scene")
      Problem.error(Code.Sandboxed, output.pos, message, help)

  /** A pipe would be written to for ever, if nobody reads it. */
  private def irregular(file: Path, output: Output): Option[Problem] =
    val isOther = !output.isAsked && Files.exists(file) && canonical(file).isEmpty
    Option.when(isOther || (output.isRewritten && WholeFile.isPipe(file))):
      val message = s"expected a regular file for the ${output.kind}, found a pipe or a device: " +
        s"`$file`"
      val help = Some(
        if output.isAsked then "choose another file" else s"--${output.option} FILE names another"
      )
      Problem.error(Code.Unwritable, output.pos, message, help)

  /** Notes files that will be written.
    *
    * @throws SceneError if one can't be
    */
  def write(output: Output): Unit =
    check(output)
    note(output)

  /** As [[write]], without a look at the file system.
    *
    * @throws SceneError if one is noted already
    */
  def note(output: Output): Unit =
    for file <- output.files ++ output.beside; path <- canonical(file) do
      for other <- outputs.get(path) do throw overwrite(file, output, other)
      outputs += path -> output

  private def overwrite(file: Path, output: Output, other: Output): SceneError =
    val existing = if other.kind == output.kind then "that" else s"the ${other.kind}"
    val message =
      s"the ${output.kind} of `${output.of}` would overwrite $existing of `${other.of}`: "
    val help =
      if other.of == output.of then s"choose another name with --${output.option} FILE"
      else "render them separately, with --outfile"
    SceneError(Problem.general(Code.OutputConflict, message + file, Some(help)))

private[candela] object Output:
  def film(file: Path, of: String, option: String = "outfile"): Output =
    val previous = Vector(FilmFile.previous(file))
    Output(Vector(file), "film", of, option, beside = previous, isRewritten = true)

private[candela] object FileRegister:

  /** Why a file can't be written. */
  def obstacle(file: Path): Option[Problem] =
    WholeFile.obstacle(file).map(unwritable(file, _))

  private def unwritable(file: Path, why: String): Problem =
    val cure = if why.startsWith("no such folder") then "make the folder, or " else ""
    val help = Some(cure + "choose another file")
    Problem.general(Code.Unwritable, s"can't write `$file`: $why", help)

  /** A path that all names of a file have, by links or in other cases, whether it exists or not.
    * None for pipes and devices.
    */
  private def canonical(file: Path): Option[Path] =
    Try(WholeFile.target(file)).toOption.flatten.map: target =>
      val absolute = target.toAbsolutePath
      def inFolder = absolute.getParent.toRealPath().resolve(absolute.getFileName)
      Try(target.toRealPath()).orElse(Try(inFolder)).getOrElse(absolute)

  /** What tells that a file has been read: hard links differ by their paths alone. */
  private def identities(file: Path): Vector[AnyRef] =
    val canonicalPath = this.canonical(file)
    val key = canonicalPath.flatMap: path =>
      Try(Option(Files.readAttributes(path, classOf[BasicFileAttributes]).fileKey)).toOption.flatten
    (canonicalPath ++ key).toVector
