package candela.scenefile

import candela.diagnostics.{Code, Problem, SceneError, Severity, SourcePos}
import candela.io.SceneFolder
import scala.collection.mutable

/** A statement of pbrt-v4 that a program makes, instead of a file.
  *
  * @param pos where the program makes it
  */
final case class GivenStatement(
    directive: String,
    pos: SourcePos,
    numbers: Vector[Double] = Vector.empty,
    texts: Vector[String] = Vector.empty,
    params: Vector[Param] = Vector.empty
)

/** Runs statements that a program makes one after the other; each is checked as in a file. What is
  * wrong with one is kept as a problem, and the next goes on.
  *
  * @param folder that file names are relative to
  * @param base   the scene that the statements add to, if any: of what there is once, they replace
  *               its own
  * @param placed the view of a type of camera that is placed by a transform
  */
final class StatementRunner(
    folder: SceneFolder,
    base: Option[SceneDescription] = None,
    placed: (String, AnimatedTransform) => AnimatedTransform = (_, view) => view
):
  private val problems = Problems()
  private val values = ValueReader(problems.add, () => true)
  private var failedKinds = Set.empty[NameKind]

  /** Statements of older dialects have other meanings. */
  private val foreign = base.map(_.dialect).filter(_ != Dialect.V4).map(_ => Dialect.V4)
  private val scene = SceneWriter(folder, DialectGuess(), () => true, problems.add, foreign, placed)
  base.foreach(scene.startFrom)

  def run(statement: GivenStatement): Unit =
    val directive = Directives.all(statement.directive)
    try
      // To what is whole, everything may be added
      val misplacement = if base.isEmpty then directive.misplaced(scene.worldBegin) else None
      for message <- misplacement do
        throw SceneError(Problem.error(Code.WrongPlace, statement.pos, message))
      GivenArguments(directive, statement, problems.add, values).run(scene)
    catch
      case e: SceneError =>
        failedKinds ++= NameKind.definedBy(statement.directive)
        e.problems.foreach(problems.add)

  /** Adds what else is wrong. */
  def report(problem: Problem): Unit = problems.add(problem)

  /** Changes what the scene has so far.
    *
    * @param at where the program does so
    */
  def change(at: SourcePos)(f: SceneDescription => SceneDescription): Unit =
    try scene.change(f)
    catch case e: SceneError => e.problems.map(p => p.copy(pos = Some(at))).foreach(problems.add)

  /** Parameters as a statement has them. */
  def checked(params: Vector[Param]): Vector[Param] =
    val checked = GivenParameters.checked(params, values, problems.add)
    checked.faults.foreach(problems.add)
    checked.params

  /** Where the camera is, by the current transform. */
  def placeCamera(): Unit = scene.placeCamera()

  /** What there is so far, with all problems found. */
  def result: SceneDescription =
    val unclosed = scene.blocks.unclosed
    val noWorld = Option.when(base.isEmpty && scene.worldBegin.isEmpty):
      Problem.general(Code.NoWorld, "the scene has no WorldBegin: nothing is in it")
    val (errors, warnings) =
      (problems.result() ++ unclosed ++ noWorld).partition(_.severity == Severity.Error)
    val previous = base.getOrElse(SceneDescription(Dialect.V4))
    val description = scene.description(previous.dialect, previous.warnings ++ warnings)
    description.copy(
      errors = previous.errors ++ errors,
      failedKinds = previous.failedKinds ++ failedKinds,
      dialectReason = base.fold("as it is made in code")(_.dialectReason)
    )

/** Arguments that a program has given. */
private final class GivenArguments(
    directive: Directive,
    statement: GivenStatement,
    report: Problem => Unit,
    values: ValueReader
) extends Arguments(directive, statement.pos, report):
  private val remainingNumbers = statement.numbers.iterator
  private val remainingTexts = statement.texts.iterator

  def include(file: String, nameAt: SourcePos): Unit =
    fail(nameAt, s"${directive.name} is for files only")

  def numbers(count: Int): Array[Double] =
    finite(Array.tabulate(count): i =>
      if !remainingNumbers.hasNext then wrongNumber(pos, count, i, "missing")
      remainingNumbers.next())

  def matrix(): Array[Double] = numbers(16)

  def quoted(expected: String): (String, SourcePos) =
    if !remainingTexts.hasNext then notQuoted(pos, expected, "nothing")
    (remainingTexts.next(), pos)

  def another: Option[String] = remainingTexts.nextOption()

  def word(choices: String*): String =
    val keyword = remainingTexts.nextOption()
    keyword.filter(choices.contains).getOrElse:
      notOneOf(pos, choices, keyword.fold("nothing")(f => s"`$f`"))

  protected def params(): ParamsRead = GivenParameters.checked(statement.params, values, report)

  def value(paramType: ParamType, name: String): Param =
    val param = statement.params.headOption.getOrElse(fail(pos, s"`$name` must have a value"))
    if param.paramType != paramType then
      val kinds = s"${paramType.spelling}, found ${param.paramType.spelling}"
      fail(pos, s"the value of `$name` must be of type $kinds")
    param.renamed(name)

private object GivenParameters:

  /** Of each name one; values as many as its type has, and finite. */
  def checked(written: Vector[Param], values: ValueReader, report: Problem => Unit): ParamsRead =
    val byName = mutable.LinkedHashMap.empty[String, Param]
    val faults = Vector.newBuilder[Problem]
    for p <- written do
      for earlier <- byName.remove(p.name) do
        val message = s"`${p.name}` is repeated; the earlier value is ignored"
        report(Problem.warning(Code.Redefined, earlier.pos, message))
      try byName(p.name) = valid(p, values)
      catch case e: SceneError => faults ++= e.problems
    ParamsRead(byName.values.toVector, faults.result())

  private def valid(p: Param, values: ValueReader): Param =
    for x <- p.floats.find(!_.isFinite) do
      throw SceneError(Problem.error(
        Code.ParameterValue,
        p.pos,
        s"values of `${p.name}` must be numbers, found $x"
      ))
    values.checkCount(p)
