package candela.scenefile

import candela.diagnostics.{Code, Limit, Problem, Refusal, SceneError, Severity, SourcePos, Suggest}
import candela.io.{InputFile, SceneFolder}
import java.nio.file.Path

import scala.collection.mutable
import scala.util.Try

/** One pass over a scene file.
  *
  * @param file that of `source`, if it is one
  * @param dialect decides the meaning of statements that differ between dialects
  * @param keepGoing if true, skips missing include files
  * @param world which of the file's worlds to read, from 0
  * @param defines values of `$NAME`
  * @param isHead whether to read what is before the world only
  * @param impliesWorld whether a world that is never begun begins with its first statement
  * @param cameraOf the scene whose camera the file replaces, by [[CameraStatements]] alone
  */
private[scenefile] final class ParserRun(
    source: Source,
    folder: SceneFolder,
    file: Option[InputFile],
    dialect: Dialect,
    keepGoing: Boolean,
    world: Int,
    defines: Defines,
    isHead: Boolean = false,
    impliesWorld: Boolean = false,
    cameraOf: Option[SceneDescription] = None
):
  import ParserRun.*

  private val evidence = DialectGuess()
  private val directives = mutable.HashSet.empty[Directive]
  private val problems = Problems()
  private val doubts = DoubtfulFiles(problems.add)
  private val parameters = Parameters(evidence, doubts.add, continuation, () => isV4)
  private var ofCamera = Vector.empty[(String, SourcePos)]
  private var scene = SceneWriter(folder, evidence, () => isV4, doubts.add)
  for base <- cameraOf do scene.startFromCamera(base)
  private val misplaced = Problems()

  private val sources = mutable.LinkedHashSet.from(file.map(_.path))
  private var failedKinds = Set.empty[NameKind]

  /** Whether the rest of the file is ignored. */
  private var isDone = false

  private var worldsToSkip = world

  /** The first statement after the world, and whether another world follows. */
  private var trailing = Option.empty[SourcePos]
  private var isFollowed = false

  /** Files being read, innermost first. */
  private var reading = file.toList
  private var includes = 0

  /** An Include found at the end of a parameter list: it is run after the list's statement. */
  private var postponed = Option.empty[() => Unit]

  /** Whether the dialect made a difference. */
  var queriedDialect = false

  private def isV4: Boolean =
    queriedDialect = true
    dialect == Dialect.V4

  /** The estimated dialect; valid after [[read]]. */
  def guess: Dialect = evidence.dialect

  /** Whether the file is a whole scene but for its WorldBegin, which seems to be forgotten. */
  def forgetsWorld: Boolean =
    scene.worldBegin.isEmpty && directives.exists(_.section == Section.World) &&
      directives.exists(_.section == Section.Options)

  /** The evidence for the guess. */
  def clues: Vector[DialectClue] = evidence.clues

  def read(): Unit =
    statements(Tokenizer(source, None, problems.add))
    if problems.errors == 0 then scene.blocks.unclosed.foreach(problems.add)

  /** The Film statement read so far. */
  def film: Option[Declaration] = scene.description(dialect, Vector.empty).film

  /** The directives of a camera, in order. */
  def cameraDirectives: Vector[(String, SourcePos)] = ofCamera

  /** The camera, placed by the transforms even if the file has no `Camera`; with all problems. */
  def view: SceneDescription =
    val names = ofCamera.map(_._1)
    if !names.contains("Camera") && names.exists(CameraStatements.Transforms) then
      scene.placeCamera()
    scene.description(dialect, problemsWithExcerpts)

  private def problemsWithExcerpts: Vector[Problem] =
    def reopen(name: String) = if name == source.name then source.again else Excerpts.read(name)
    Excerpts.fill(problems.result(), reopen)

  /** The description with all problems; throws these if there is no world. */
  def result(dialect: Dialect): SceneDescription =
    finish(dialect)
    val allProblems = problemsWithExcerpts
    if scene.worldBegin.isEmpty then throw SceneError(allProblems)
    val (errors, warnings) = allProblems.partition(_.severity == Severity.Error)
    val read = scene.description(dialect, warnings)
    read.copy(
      errors = errors,
      failedKinds = failedKinds,
      sources = sources.toVector,
      isFollowed = isFollowed && dialect != Dialect.V4
    )

  /** Checks possible only at the end of the file. */
  private def finish(dialect: Dialect): Unit =
    scene.worldBegin match
      case None if problems.errors == 0 =>
        val hint = "it is empty, or a file to Include"
        problems.add(Problem.general(Code.NoWorld, s"`${source.name}` has no WorldBegin; $hint"))
      case None => ()
      case Some(begin) =>
        if worldsToSkip > 0 then
          val message =
            s"`${source.name}` has no world $world; the last one is ${world - worldsToSkip}"
          problems.add(Problem.general(Code.OptionMisfit, message))
        misplaced.result().foreach(problems.add)
        scene.displacedDefinitions(dialect).foreach(problems.add)
        for at <- trailing if !isFollowed || dialect == Dialect.V4 do
          problems.add(Problem.warning(Code.NoWorld, at, "statements after WorldEnd are ignored"))
        if dialect != Dialect.V4 && scene.worldEnd.isEmpty && problems.errors == 0 then
          val message = "WorldBegin has no WorldEnd; the file may be incomplete"
          problems.add(Problem.warning(Code.NoWorld, begin, message))

  private def statements(in: Tokenizer): Unit =
    attempt(in)(in.advance())
    statementsFromHere(in)

  private def statementsFromHere(in: Tokenizer): Unit =
    def goesOn = !isDone && !problems.isFull && !doubts.areJustified(in.source.name)
    try
      while goesOn && in.current != Token.End do
        attempt(in):
          statement(in)
          doubts.dispel(in.source.name)
        if isHead && scene.worldBegin.nonEmpty then isDone = true
      if goesOn then doubts.dispel(in.source.name)
    finally in.source.close()

  /** Runs `body`; after an error, skips to the next apparent directive. */
  private inline def attempt(in: Tokenizer)(inline body: Unit): Unit =
    try body
    catch
      case e: SceneError =>
        e.problems.foreach(doubts.add)
        // A misspelt directive is told, too, but a misspelt argument not again as a directive
        if !in.startsName || !in.startsLine then skipToDirective(in)
      case Refusal.OfFile(problem) =>
        problems.add(problem)
        skipToDirective(in)

  private def skipToDirective(in: Tokenizer): Unit =
    val isThere = in.current == Token.Word && Directives.all.contains(in.text)
    if !isThere then in.advanceToName()

  private def statement(in: Tokenizer): Unit =
    val position = in.pos
    folder.allowance.checkTime(Some(position))
    val directive = if in.current == Token.Word then Directives.named(in.text) else null
    if directive == null then unknown(in)
    else if cameraOf.nonEmpty && !CameraStatements.Allowed(directive.name) then
      in.advance()
      throw SceneError(CameraStatements.unexpected(directive.name, position))
    else if scene.worldEnd.nonEmpty && worldsToSkip == 0 then
      trailing = trailing.orElse(Some(position))
      isFollowed = directive.name == "WorldBegin"
      isDone = isFollowed
      if !isDone then in.advanceToName()
    else
      if scene.worldEnd.nonEmpty then beginNext()
      // The first of each: there are millions
      if directives.add(directive) then evidence.uses("directive", directive.name, position)
      if cameraOf.nonEmpty then ofCamera :+= (directive.name -> position)
      in.advance()
      if isMisplaced(directive, position) then skipToDirective(in)
      else run(directive, position, in)

  /** Forgets the world just read; v2 keeps the settings of the image. */
  private def beginNext(): Unit =
    worldsToSkip -= 1
    problems.clear()
    misplaced.clear()
    failedKinds = Set.empty
    val previousWorld = scene
    scene = SceneWriter(folder, evidence, () => isV4, doubts.add)
    if evidence.dialect == Dialect.V2 then scene.copySettings(previousWorld)

  private def run(directive: Directive, at: SourcePos, in: Tokenizer): Unit =
    val arguments = WrittenArguments(directive, at, in, parameters, doubts.add, include(in))
    try losing(directive.name)(arguments.run(scene))
    catch
      case e: SceneError =>
        // A skipped block statement would make its counterpart look unbalanced.
        if directive.name.endsWith("Begin") || directive.name.endsWith("End") then
          scene.blocks.isDoubtful = true
        throw e
    finally
      val postponedInclude = postponed
      postponed = None
      for include <- postponedInclude do attempt(in)(losing("Include")(include()))

  /** Runs a directive; if that fails, the names that it may have defined are lost. */
  private inline def losing(directive: String)(inline body: Unit): Unit =
    try body
    catch
      case e: (SceneError | Refusal) =>
        failedKinds ++= NameKind.definedBy(directive)
        throw e

  private def unknown(in: Tokenizer): Nothing =
    val (at, shown) = (in.pos, in.description)
    val problem =
      if in.current != Token.Word || in.isNumber then
        val help = "write several values of a parameter in brackets: [ … ]"
        Problem.error(Code.NoDirective, at, s"expected a directive, found $shown", Some(help))
      else
        scene.blocks.isDoubtful = true
        val help =
          if in.touchesQuote then
            Some("check the quotes: one is missing before this one, or one is too many")
          else Suggest.help(in.text, Directives.all.keys)
        Problem.error(Code.UnknownDirective, at, s"unknown directive $shown", help)
    in.advance()
    throw SceneError(problem)

  /** Reports a statement on the wrong side of WorldBegin: an error in v4, ignored in v2 and v3. */
  private def isMisplaced(directive: Directive, at: SourcePos): Boolean =
    if impliesWorld && directive.section == Section.World && scene.worldBegin.isEmpty then
      beginMissingWorld(directive, at)
    val misplacement = directive.misplaced(scene.worldBegin)
    for message <- misplacement if !misplaced.isFull do
      misplaced.add(
        if isV4 then Problem.error(Code.WrongPlace, at, message)
        else Problem.warning(Code.WrongPlace, at, s"$message; ignored")
      )
    misplacement.nonEmpty

  /** Reports a forgotten WorldBegin, unless an error before it may be the cause. */
  private def beginMissingWorld(directive: Directive, at: SourcePos): Unit =
    if problems.errors == 0 then
      val message = s"${directive.name} must be after WorldBegin, and there is none"
      val help = "write WorldBegin before this statement"
      problems.add(Problem.error(Code.NoWorld, at, message, Some(help)))
    scene.beginWorld(at)

  /** Reads the statements of another file, which `from` includes. */
  private def include(from: Tokenizer)(name: String, nameAt: SourcePos, at: SourcePos): Unit =
    openIncluded(name, nameAt, at) match
      case Right(opened) => withIncluded(from, opened)(statements(opened.text))
      case Left(missing) => skip(missing, from, nameAt)

  /** Passes over a file that can't be read, if that is asked for. */
  private def skip(missing: Missing, from: Tokenizer, nameAt: SourcePos): Unit =
    val problem =
      Problem.missing(missing.code, nameAt, missing.message, "skipped", keepGoing, missing.help)
    if !keepGoing then throw SceneError(problem)
    problems.add(problem)
    // Skips the parameters that continue the missing file's last statement.
    val _ = parameters.list(from)

  /** Opens a file at its start.
    *
    * @throws SceneError if it may not be included
    */
  private def openIncluded(
      name: String,
      nameAt: SourcePos,
      at: SourcePos
  ): Either[Missing, Included] =
    resolve(name, nameAt) match
      case None =>
        val searched = folders.map(f => if f.toString.isEmpty then "`.`" else s"`$f`")
        val suggestion = folders.flatMap(f => folder.at(f).suggestion(name)).headOption
        val help = suggestion.getOrElse(s"looked in ${searched.mkString(" and ")}")
        Left(Missing(Code.NoSuchFile, s"can't include `$name`: no such file", Some(help)))
      case Some(file) =>
        for reason <- circle(file, name) do
          throw SceneError(Problem.error(Code.IncludeCircle, nameAt, reason))
        countInclude(nameAt)
        Source.readNamed(file).map(defines.substitute) match
          case Left(reason) => Left(Missing(Code.NoScene, s"can't include `$name`: $reason", None))
          case Right(source) =>
            sources += file.path
            if !file.isShown then doubts.raise(file.toString)
            Right(Included(file, Tokenizer(source, Some(at), problems.add)))

  /** Runs `body`, which reads the file. */
  private def withIncluded(from: Tokenizer, included: Included)(body: => Unit): Unit =
    val outer = reading
    reading = included.file :: outer
    try parameters.withOuter(from)(body)
    finally reading = outer

  /** The file of an Include at the current token of `from`, if it begins with parameters; the
    * statements after them are postponed. Any other Include is postponed as a whole.
    */
  private def continuation(from: Tokenizer): Option[Tokenizer] =
    val isInclude = from.current == Token.Word && from.text == "Include" && from.nextIsText
    if !isInclude then None
    else
      val position = from.pos
      evidence.uses("directive", "Include", position)
      from.advance()
      val (name, nameAt) = (from.text, from.pos)
      from.advance()
      val opened = Try(openIncluded(name, nameAt, position))
      val beginning = opened.toOption.flatMap(_.toOption).map(_.text).filter(_.nextIsText)
      postponed = Some: () =>
        opened.get match
          case Right(file) =>
            withIncluded(from, file):
              if beginning.isEmpty then statements(file.text) else statementsFromHere(file.text)
          case Left(missing) => skip(missing, from, nameAt)
      for text <- beginning do
        try text.advance()
        catch
          case e: SceneError =>
            postponed = None
            text.source.close()
            throw e
      beginning

  /** Files that include others several times are read exponentially often. */
  private def countInclude(at: SourcePos): Unit =
    folder.allowance.check(Limit.Depth, reading.size, Some(at)):
      s"includes are nested ${reading.size} deep"
    includes += 1
    if includes > MaxIncludes then
      isDone = true
      throw SceneError(Problem.error(
        Code.IncludeCircle,
        at,
        s"more than ${MaxIncludes} files are included"
      ))

  /** Why a file can't be included here. */
  private def circle(file: InputFile, name: String): Option[String] =
    if reading.exists(_.isSame(file)) then
      val chain = reading.takeWhile(!_.isSame(file)).reverse
      Some(s"`$name` includes itself${chain.map(f => s", through `$f`").mkString}")
    else
      Option.when(reading.size > MaxIncludeDepth):
        s"includes are nested more than ${MaxIncludeDepth} deep"

  /** Resolves against the scene's folder, as in all three renderers; else against the including
    * file's.
    */
  private def resolve(name: String, at: SourcePos): Option[InputFile] =
    folder.existing(folders, name, Some(at))

  private def folders: List[Path] =
    (folder.path :: reading.headOption.map(f => SceneFolder.of(f.path).path).toList).distinct

private[scenefile] object ParserRun:
  /** An included file, opened. */
  private final case class Included(file: InputFile, text: Tokenizer)

  /** Why a file is not included. */
  private final case class Missing(code: Code, message: String, help: Option[String])

  /** More than any scene needs, and far from a stack overflow. */
  private val MaxIncludeDepth = 200

  /** Counted as often as they are included. */
  private val MaxIncludes = 100_000
