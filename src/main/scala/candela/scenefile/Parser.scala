package candela.scenefile

import java.nio.file.Path

import candela.base.{Problem, SceneError}

/** Reads scene files. */
object Parser:

  /** The scene of a file and all that it includes; a [[SceneError]] has the problems found.
    *
    * @param dialect the file's dialect; None: recognise it
    */
  def parse(file: Path, dialect: Option[Dialect] = None): SceneDescription =
    whole(readable(file, dialect, keepGoing = false))

  /** As much of a scene as can be understood; see [[SceneDescription.errors]].
    *
    * @param keepGoing pass over files to include that are missing
    * @throws SceneError if there is no scene in the file at all
    */
  def readable(file: Path, dialect: Option[Dialect], keepGoing: Boolean): SceneDescription =
    Source.read(file) match
      case Right(source) => read(source, folderOf(file), Some(file), dialect, keepGoing)
      case Left(why) =>
        throw SceneError(Problem.general(s"can't read the scene file `$file`: $why"))

  /** The scene of a text.
    *
    * @param name   how messages call it
    * @param folder the folder against which file names resolve
    */
  def parseText(
      name: String,
      text: String,
      folder: Path,
      dialect: Option[Dialect] = None,
      keepGoing: Boolean = false
  ): SceneDescription =
    whole(read(Source.fromText(name, text), folder, None, dialect, keepGoing))

  private def whole(scene: SceneDescription): SceneDescription =
    if scene.errors.isEmpty then scene
    else throw SceneError(scene.errors ++ scene.warnings)

  private[scenefile] def folderOf(file: Path): Path = Option(file.getParent).getOrElse(Path.of(""))

  private def read(
      source: Source,
      folder: Path,
      file: Option[Path],
      dialect: Option[Dialect],
      keepGoing: Boolean
  ): SceneDescription =
    attempt(source, folder, file, dialect, keepGoing) match
      case Right(scene) => scene
      case Left(better) =>
        val once = source.again.getOrElse:
          throw SceneError(Problem.general(s"can't read `${source.name}` a second time"))
        attempt(once, folder, file, Some(better), keepGoing).toOption.get

  /** The scene; or the dialect with which it must be read once more: the few statements that v4
    * treats otherwise were read as v3's.
    */
  private def attempt(
      source: Source,
      folder: Path,
      file: Option[Path],
      dialect: Option[Dialect],
      keepGoing: Boolean
  ): Either[Dialect, SceneDescription] =
    val run = ParserRun(source, folder, file, dialect.getOrElse(Dialect.V3), keepGoing)
    run.read()
    val guess = dialect.getOrElse(run.guess)
    if dialect.isEmpty && run.askedDialect && guess == Dialect.V4 then Left(guess)
    else Right(run.result(guess))
