package candela.scenefile

import candela.diagnostics.{Code, Problem, SceneError, SourcePos}

/** The arguments of a directive; each method takes some, or throws a located error.
  *
  * @param pos position of the directive's name
  */
abstract class Arguments(directive: Directive, val pos: SourcePos, val report: Problem => Unit):

  protected final def fail(at: SourcePos, message: String): Nothing =
    throw SceneError(Problem.error(Code.Arguments, at, message, Some(usage)))

  private def usage = s"usage: ${directive.name} ${directive.usage}".trim

  protected final def wrongNumber(at: SourcePos, count: Int, i: Int, actual: String): Nothing =
    fail(at, s"${directive.name} expects $count numbers; number ${i + 1} is $actual")

  /** As Floats, which most of what is placed has. */
  protected final def finite(values: Array[Double]): Array[Double] =
    val i = values.indexWhere(x => !(Math.abs(x) <= Float.MaxValue))
    if i < 0 then values else wrongNumber(pos, values.length, i, s"${values(i)}")

  protected final def notQuoted(at: SourcePos, expected: String, actual: String): Nothing =
    fail(at, s"${directive.name} expects $expected in quotes, found $actual")

  protected final def notOneOf(at: SourcePos, choices: Seq[String], actual: String): Nothing =
    val quotedChoices = choices.mkString("`", "`, `", "`")
    fail(at, s"${directive.name} expects one of $quotedChoices, found $actual")

  /** Runs the statements of another file in place.
    *
    * @param nameAt position of the file's name
    */
  def include(file: String, nameAt: SourcePos): Unit

  /** The next `count` numbers, unboxed: there are millions. */
  def numbers(count: Int): Array[Double]

  /** A 4×4 matrix in column order. */
  def matrix(): Array[Double]

  /** A quoted string and its position. */
  def quoted(expected: String): (String, SourcePos)

  /** A quoted string, if one is next. */
  def another: Option[String]

  /** One of the keywords `choices`. */
  def word(choices: String*): String

  protected def params(): ParamsRead

  private var faultsSoFar = Vector.empty[Problem]

  /** What is wrong with parameters: the statement is run without them. */
  final def faults: Vector[Problem] = faultsSoFar

  /** A quoted name and parameters. */
  final def named(expected: String = "a name"): Named =
    val (name, at) = quoted(expected)
    val read = params()
    faultsSoFar = read.faults
    Named(name, at, read.params, isFaulty = read.faults.nonEmpty)

  /** Runs the directive.
    *
    * @throws SceneError with all that is wrong
    */
  final def run(scene: SceneWriter): Unit =
    try directive.run(this, scene)
    catch case e: SceneError => throw SceneError(faults ++ e.problems)
    if faults.nonEmpty then throw SceneError(faults)

  /** One value without a preceding `"type name"`. */
  def value(paramType: ParamType, name: String): Param

/** Arguments that a file contains.
  *
  * @param including reads a file: its name, where that is, and where its directive is
  */
private[scenefile] final class WrittenArguments(
    directive: Directive,
    pos: SourcePos,
    in: Tokenizer,
    parameters: Parameters,
    report: Problem => Unit,
    including: (String, SourcePos, SourcePos) => Unit
) extends Arguments(directive, pos, report):

  def include(file: String, nameAt: SourcePos): Unit = including(file, nameAt, pos)

  def numbers(count: Int): Array[Double] =
    val values = new Array[Double](count)
    val read = in.readDoubles(values)
    if read < count then
      val actual = if in.current == Token.End then "missing: the file ends here" else in.description
      wrongNumber(in.pos, count, read, actual)
    finite(values)

  /** With or without brackets. */
  def matrix(): Array[Double] =
    val isList = in.current == Token.Open
    if isList then in.advance()
    val values = numbers(16)
    if isList then
      if in.current != Token.Close then
        fail(in.pos, s"${directive.name} expects `]` after 16 numbers, found ${in.description}")
      in.advance()
    values

  def quoted(expected: String): (String, SourcePos) =
    if in.current != Token.Text then
      val unquoted = if in.description == s"`${in.text}`" then " without them" else ""
      notQuoted(in.pos, expected, in.description + unquoted)
    val text = (in.text, in.pos)
    in.advance()
    text

  def another: Option[String] =
    Option.when(in.current == Token.Text):
      val text = in.text
      in.advance()
      text

  /** Without quotes. */
  def word(choices: String*): String =
    if in.current != Token.Word || !choices.contains(in.text) then
      notOneOf(in.pos, choices, in.description)
    val text = in.text
    in.advance()
    text

  protected def params(): ParamsRead = parameters.list(in)
  def value(paramType: ParamType, name: String): Param = parameters.value(paramType, name, in)

/** A quoted name with its position, and the parameters after it.
  *
  * @param isFaulty whether some could not be read
  */
final case class Named(
    name: String,
    pos: SourcePos,
    params: Vector[Param],
    isFaulty: Boolean = false
)
