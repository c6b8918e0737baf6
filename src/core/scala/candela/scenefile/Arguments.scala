package candela.scenefile

import candela.base.{Problem, SceneError, SourcePos}

/** Reads the arguments of a directive; each method reads some, or throws a located error.
  *
  * @param at position of the directive's name
  */
final class Arguments(
    directive: Directive,
    val at: SourcePos,
    in: Tokenizer,
    parameters: Parameters,
    val report: Problem => Unit,
    including: (String, SourcePos, SourcePos) => Unit
):

  private def fail(at: SourcePos, message: String) =
    throw SceneError(Problem.error(at, message, Some(usage)))

  private def usage = s"usage: ${directive.name} ${directive.usage}".trim

  /** Reads the statements of another file in place.
    *
    * @param nameAt position of the file's name
    */
  def include(file: String, nameAt: SourcePos): Unit = including(file, nameAt, at)

  /** The next `count` numbers. */
  def numbers(count: Int): Vector[Double] =
    Vector.tabulate(count): i =>
      val value = in.numberHere.getOrElse:
        val found = if in.current == Token.End then "missing: the file ends here" else in.shown
        fail(in.at, s"${directive.name} expects $count numbers; number ${i + 1} is $found")
      in.advance()
      value

  /** A 4×4 matrix in column order, with or without brackets. */
  def matrix(): Vector[Double] =
    val isList = in.current == Token.Open
    if isList then in.advance()
    val values = numbers(16)
    if isList then
      if in.current != Token.Close then
        fail(in.at, s"${directive.name} expects `]` after 16 numbers, found ${in.shown}")
      in.advance()
    values

  /** A quoted string and its position. */
  def quoted(what: String): (String, SourcePos) =
    if in.current != Token.Text then
      fail(in.at, s"${directive.name} expects $what in quotes, found ${in.shown}")
    val text = (in.text, in.at)
    in.advance()
    text

  /** A quoted string, if one is next. */
  def another: Option[String] =
    Option.when(in.current == Token.Text):
      val text = in.text
      in.advance()
      text

  /** One of the keywords `choices`, without quotes. */
  def word(choices: String*): String =
    if in.current != Token.Word || !choices.contains(in.text) then
      val known = choices.mkString("`", "`, `", "`")
      fail(in.at, s"${directive.name} expects one of $known, found ${in.shown}")
    val text = in.text
    in.advance()
    text

  def params(): Vector[Param] = parameters.list(in)

  /** A quoted name and parameters. */
  def named(what: String = "a name"): Named =
    val (name, at) = quoted(what)
    Named(name, at, params())

  /** One value without a preceding `"type name"`. */
  def value(paramType: ParamType, name: String): Param = parameters.value(paramType, name, in)
