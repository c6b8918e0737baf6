package candela.scenefile

import java.nio.file.{Files, InvalidPathException, Path}

import candela.base.{Problem, SceneError, Severity, SourcePos, Suggest}

/** One reading of a scene file.
  *
  * @param file    the path of `source`, if it is a file
  * @param dialect   decides where the dialects differ in what a statement means
  * @param keepGoing pass over files to include that are missing
  */
private[scenefile] final class ParserRun(
    source: Source,
    folder: Path,
    file: Option[Path],
    dialect: Dialect,
    keepGoing: Boolean
):
  private val evidence = DialectGuess()
  private val problems = Problems()
  private val parameters = Parameters(evidence, problems.add)
  private val scene = SceneWriter(folder, evidence, () => isV4, problems.add)
  private val misplaced = Problems()

  private var lost = Set.empty[NameKind]

  /** Has everything been read that counts? */
  private var isDone = false

  /** Did the dialect make a difference? */
  var askedDialect = false

  private def isV4: Boolean =
    askedDialect = true
    dialect == Dialect.V4

  /** The dialect that the file seems to be in; meaningful after [[read]]. */
  def guess: Dialect = evidence.dialect

  def read(): Unit =
    statements(source, None, file.toList)
    if problems.errors == 0 then scene.blocks.unclosed.foreach(problems.add)

  /** The description with all problems; only these if there is no world. */
  def result(dialect: Dialect): SceneDescription =
    finish(dialect)
    def open(name: String) = if name == source.name then source.again else Excerpts.read(name)
    val all = Excerpts.fill(problems.result(), open)
    if scene.worldBegin.isEmpty then throw SceneError(all)
    val (errors, warnings) = all.partition(_.severity == Severity.Error)
    scene.description(dialect, warnings).copy(errors = errors, lost = lost)

  /** What can be told only at the end. */
  private def finish(dialect: Dialect): Unit =
    scene.worldBegin match
      // without its world nothing is at its place; the cause is reported already, or is this:
      case None if problems.errors == 0 =>
        val what = "it is a part to Include, not a whole scene"
        problems.add(Problem.general(s"`${source.name}` has no WorldBegin: $what"))
      case None => ()
      case Some(begin) =>
        misplaced.result().foreach(problems.add)
        if dialect != Dialect.V4 && scene.worldEnd.isEmpty && problems.errors == 0 then
          problems.add(Problem.warning(begin, "no WorldEnd follows: is the file complete?"))

  /** @param files the files being read, innermost first */
  private def statements(from: Source, includedAt: Option[SourcePos], files: List[Path]): Unit =
    val in = Tokenizer(from, includedAt)
    try
      attempt(in)(in.advance())
      while !isDone && !problems.isFull && in.current != Token.End do
        attempt(in)(statement(in, files))
    finally from.close()

  /** Runs `body`; after an error what looks like the next directive becomes the current token. */
  private def attempt(in: Tokenizer)(body: => Unit): Unit =
    try body
    catch
      case e: SceneError =>
        e.problems.foreach(problems.add)
        skipToDirective(in)

  private def skipToDirective(in: Tokenizer): Unit =
    val isThere = in.current == Token.Word && Directives.all.contains(in.text)
    if !isThere then in.advanceToName()

  private def statement(in: Tokenizer, files: List[Path]): Unit =
    val at = in.at
    Directives.all.get(in.text).filter(_ => in.current == Token.Word) match
      case None => unknown(in)
      case Some(_) if scene.worldEnd.nonEmpty =>
        val message = "statements after WorldEnd are ignored"
        problems.add(Problem.warning(at, message, Some("put every frame into a file of its own")))
        isDone = true
      case Some(directive) =>
        evidence.uses("directive", directive.name)
        in.advance()
        if isMisplaced(directive, at) then skipToDirective(in)
        else run(directive, at, in, files)

  private def run(directive: Directive, at: SourcePos, in: Tokenizer, files: List[Path]): Unit =
    val including = include(in, files)
    try directive.run(Arguments(directive, at, in, parameters, problems.add, including), scene)
    catch
      case e: SceneError =>
        lost ++= NameKind.madeBy(directive.name)
        // the block's other end would be called unbalanced for no fault of its own
        if directive.name.endsWith("Begin") || directive.name.endsWith("End") then
          scene.blocks.isDoubtful = true
        throw e

  private def unknown(in: Tokenizer): Nothing =
    val (at, shown) = (in.at, in.shown)
    val problem =
      if in.current != Token.Word || in.numberHere.nonEmpty then
        val help = "several values of one parameter need brackets: [ … ]"
        Problem.error(at, s"expected a directive, but here is $shown", Some(help))
      else
        scene.blocks.isDoubtful = true
        val help = Suggest.help(in.text, Directives.all.keys)
        Problem.error(at, s"no directive is called $shown", help)
    in.advance()
    throw SceneError(problem)

  /** v4 stops at a statement that belongs into the other part of the file; v2 and v3 ignore it. */
  private def isMisplaced(directive: Directive, at: SourcePos): Boolean =
    val message = (directive.place, scene.worldBegin) match
      case (Place.Options, Some(begin)) if directive.name == "WorldBegin" =>
        s"WorldBegin again: the first is at $begin"
      case (Place.Options, Some(begin)) =>
        s"${directive.name} belongs before WorldBegin (at $begin)"
      case (Place.World, None) => s"${directive.name} belongs after WorldBegin"
      case _ => ""
    if message.nonEmpty && !misplaced.isFull then
      misplaced.add(
        if isV4 then Problem.error(at, message)
        else Problem.warning(at, s"$message; it is ignored")
      )
    message.nonEmpty

  /** Reads another file's statements.
    *
    * @param from  what reads the file that includes it
    * @param files the files being read, innermost first
    */
  private def include(from: Tokenizer, files: List[Path])(
      name: String,
      nameAt: SourcePos,
      at: SourcePos
  ): Unit =
    def fail(message: String): Nothing = throw SceneError(Problem.error(nameAt, message))
    def missing(message: String, help: Option[String] = None): Unit =
      val problem = Problem.missing(nameAt, message, "it is passed over", keepGoing, help)
      if !keepGoing then throw SceneError(problem)
      problems.add(problem)
      // those of the file's last statement
      val _ = parameters.list(from)
    resolve(name, files.headOption) match
      case None =>
        val folders = (folder :: files.headOption.map(Parser.folderOf).toList).distinct
        val shown = folders.map(f => if f.toString.isEmpty then "`.`" else s"`$f`")
        val near = folders.flatMap(f => Suggest.file(f.resolve(name))).headOption
        val help = near.getOrElse(s"looked in ${shown.mkString(" and ")}")
        missing(s"can't include `$name`: there is no such file", Some(help))
      case Some(path) =>
        refuseCircles(path, name, files, fail)
        Source.read(path) match
          case Right(source) =>
            parameters.within(from)(statements(source, Some(at), path :: files))
          case Left(why) => missing(s"can't include `$name`: $why")

  private def refuseCircles(
      path: Path,
      name: String,
      files: List[Path],
      fail: String => Nothing
  ): Unit =
    if files.exists(Files.isSameFile(_, path)) then
      val chain = files.takeWhile(!Files.isSameFile(_, path)).reverse
      fail(s"`$name` includes itself${chain.map(f => s", through `$f`").mkString}")
    if files.size > ParserRun.DeepestInclude then
      fail(s"more than ${ParserRun.DeepestInclude} files include one another")

  /** Against the scene's folder, as the three renderers do; else against the including file's. */
  private def resolve(name: String, from: Option[Path]): Option[Path] =
    try
      val candidates = folder.resolve(name) :: from.map(Parser.folderOf(_).resolve(name)).toList
      candidates.find(Files.exists(_))
    catch case _: InvalidPathException => None

private[scenefile] object ParserRun:
  /** Deeper than any scene needs, and far from the end of a thread's stack. */
  private val DeepestInclude = 200
