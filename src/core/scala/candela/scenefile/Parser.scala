package candela.scenefile

import candela.diagnostics.{Code, Problem, Refusal, SceneError, SourcePos}
import candela.io.{InputFile, SceneFolder}
import java.nio.file.Path

/** Parses scene files. */
object Parser:

  /** Parses a file and its includes; throws a [[SceneError]] with all problems found.
    *
    * @param dialect dialect of the file; None: auto-detected
    */
  def parse(file: Path, dialect: Option[Dialect] = None): SceneDescription =
    validated(readable(file, dialect, keepGoing = false))

  /** Parses the readable part of a scene; see [[SceneDescription.errors]].
    *
    * @param keepGoing if true, skips missing include files
    * @param world which of the file's worlds, from 0: v2's and v3's files may have several
    * @param within the scene's folder, if it is confined or has limits
    * @param defines values of `$NAME` in its files
    * @throws SceneError if the file contains no scene at all
    */
  def readable(
      file: Path,
      dialect: Option[Dialect],
      keepGoing: Boolean,
      world: Int = 0,
      within: Option[SceneFolder] = None,
      defines: Defines = Defines.Nothing
  ): SceneDescription =
    val folder = within.getOrElse(SceneFolder.of(file))
    val opened = folder.scene(file)
    Refusal.placed(start(file))(Source.read(opened, Content.Tokens).map(defines.substitute)) match
      case Right(source) => read(source, folder, Some(opened), dialect, keepGoing, world, defines)
      case Left(reason) =>
        throw SceneError(Problem.general(
          Code.Unreadable,
          s"can't read the scene file `$file`: $reason"
        ))

  private def start(file: Path) = SourcePos(file.toString, 1, 1)

  /** The Film statement of a scene's first world, if it can be read; not the world itself. */
  def film(
      file: Path,
      dialect: Option[Dialect],
      within: SceneFolder,
      defines: Defines = Defines.Nothing
  ): Option[Declaration] =
    val opened = within.scene(file)
    Source.read(opened, Content.Nothing).toOption.map(defines.substitute).flatMap: source =>
      val run = ParserRun(
        source,
        within,
        Some(opened),
        dialect.getOrElse(Dialect.V3),
        keepGoing = true,
        world = 0,
        defines,
        isHead = true
      )
      run.read()
      run.film

  /** Parses a scene from a string.
    *
    * @param name name in messages
    * @param folder folder that file names are relative to
    */
  def parseText(
      name: String,
      text: String,
      folder: Path,
      dialect: Option[Dialect] = None,
      keepGoing: Boolean = false,
      world: Int = 0
  ): SceneDescription =
    validated(readableText(name, text, SceneFolder(folder), dialect, keepGoing, world = world))

  /** The readable part of a scene in a string; see [[SceneDescription.errors]]. */
  def readableText(
      name: String,
      text: String,
      within: SceneFolder,
      dialect: Option[Dialect],
      keepGoing: Boolean,
      defines: Defines = Defines.Nothing,
      world: Int = 0
  ): SceneDescription =
    val source = defines.substitute(Source.fromText(name, text))
    read(source, within, None, dialect, keepGoing, world, defines)

  /** The scene, if it has no errors. */
  def validated(scene: SceneDescription): SceneDescription =
    if scene.errors.isEmpty then scene
    else throw SceneError(scene.errors ++ scene.warnings)

  private def read(
      source: Source,
      folder: SceneFolder,
      file: Option[InputFile],
      dialect: Option[Dialect],
      keepGoing: Boolean,
      world: Int,
      defines: Defines
  ): SceneDescription =
    // The scene; or how to read it again
    def attempt(
        source: Source,
        dialect: Option[Dialect],
        impliesWorld: Boolean
    ): Either[(Dialect, Boolean), SceneDescription] =
      val run = ParserRun(
        source,
        folder,
        file,
        dialect.getOrElse(Dialect.V3),
        keepGoing,
        world,
        defines,
        impliesWorld = impliesWorld
      )
      run.read()
      val guess = dialect.getOrElse(run.guess)
      // The few statements that v4 treats differently were parsed as v3's
      val isOther = dialect.isEmpty && run.queriedDialect && guess == Dialect.V4
      if isOther || run.forgetsWorld then Left((guess, run.forgetsWorld))
      else Right(run.result(guess).copy(clues = run.clues))
    val scene = attempt(source, dialect, impliesWorld = false) match
      case Right(scene) => scene
      case Left((guess, forgetsWorld)) =>
        val reopened = source.again.getOrElse:
          throw SceneError(Problem.general(
            Code.Unreadable,
            s"can't read `${source.name}` a second time"
          ))
        folder.allowance.readAgain()
        attempt(defines.substitute(reopened), Some(guess), forgetsWorld).toOption.get
    defines.requireUse()
    scene
