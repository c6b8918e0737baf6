package candela.scenefile

import candela.base.{Problem, SceneError, SourcePos}

/** What follows a directive's name: each method reads a part of it, or says what is wrong there.
  *
  * @param at where the directive's name stands
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

  private def found: String =
    if in.current == Token.End then "missing: the file ends here" else in.shown

  /** Reads the statements of another file here and now.
    *
    * @param nameAt where its name is written
    */
  def include(file: String, nameAt: SourcePos): Unit = including(file, nameAt, at)

  /** The next `count` numbers. */
  def numbers(count: Int): Vector[Double] =
    Vector.tabulate(count): i =>
      val value = in.numberHere.getOrElse:
        val takes = s"${directive.name} takes $count numbers"
        fail(in.at, s"$takes, but number ${i + 1} is $found")
      in.advance()
      value

  /** 16 numbers, column by column, with or without brackets. */
  def matrix(): Vector[Double] =
    val isList = in.current == Token.Open
    if isList then in.advance()
    val values = numbers(16)
    if isList then
      if in.current != Token.Close then
        fail(in.at, s"${directive.name} takes 16 numbers, but here is $found instead of `]`")
      in.advance()
    values

  /** A quoted text, and where it stands. */
  def quoted(what: String): (String, SourcePos) =
    if in.current != Token.Text then
      fail(in.at, s"${directive.name} takes $what in quotes, but here is $found")
    val text = (in.text, in.at)
    in.advance()
    text

  /** A quoted text, if one is next. */
  def another: Option[String] =
    Option.when(in.current == Token.Text):
      val text = in.text
      in.advance()
      text

  /** One of the words, without quotes. */
  def word(choices: String*): String =
    if in.current != Token.Word || !choices.contains(in.text) then
      val known = choices.mkString("`", "`, `", "`")
      fail(in.at, s"${directive.name} takes $known, but here is $found")
    val text = in.text
    in.advance()
    text

  def params(): Vector[Param] = parameters.list(in)

  /** `"name"` and parameters. */
  def named(what: String = "a name"): Named =
    val (name, at) = quoted(what)
    Named(name, at, params())

  /** One value without a `"type name"` before it. */
  def value(paramType: ParamType, name: String): Param = parameters.value(paramType, name, in)
