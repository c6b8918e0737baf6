package candela.scenefile

import candela.base.{FloatBuffer, IntBuffer, RestBuffer}
import candela.diagnostics.{Code, Problem, SceneError, SourcePos}

/** Reads parameter values and checks them against the parameter's type.
  *
  * @param warn receives warnings
  * @param isV4 whether the scene is v4's, where excess values are an error
  */
final class ValueReader(warn: Problem => Unit, isV4: () => Boolean):
  private val floats = FloatBuffer()
  private val rests = RestBuffer()
  private val ints = IntBuffer()

  /** Reads a value or a bracketed list from the current token on.
    *
    * @param at position of the parameter
    */
  def read(paramType: ParamType, name: String, at: SourcePos, in: Tokenizer): Param =
    val openBracket = Option.when(in.current == Token.Open)(in.pos)
    val valuesAt = if openBracket.nonEmpty then in.nextPos else in.pos
    val isText = if openBracket.nonEmpty then in.nextIsText else in.current == Token.Text
    val isList = openBracket.nonEmpty
    val param = paramType match
      case ParamType.Integer =>
        Param(paramType, name, at, valuesAt, ints = integers(name, valuesAt, in, isList))
      case ParamType.Bool =>
        val values = words(in, isList)(t => Bools.contains(t.text))
        Param(paramType, name, at, valuesAt, bools = values.map(_ == "true"))
      case ParamType.String | ParamType.Texture =>
        Param(paramType, name, at, valuesAt, strings = texts(in, isList))
      case ParamType.Spectrum if isText =>
        Param(paramType, name, at, valuesAt, strings = texts(in, isList))
      case _ =>
        val values = numbers(in, isList)
        val missing = rests.drain(values.length)
        val isPosition = paramType == ParamType.Point3 || name == "Pw"
        val coarseRests = if isPosition then missing else Array.emptyFloatArray
        Param(paramType, name, at, valuesAt, floats = values, rests = coarseRests)
    openBracket match
      case Some(_) if in.current == Token.Close => in.advance()
      case Some(_) => throw SceneError(misfit(param, in, openBracket))
      case None => if count(param) == 0 then throw SceneError(misfit(param, in, None))
    checkCount(param)

  // Each reads as many values as match (at most one outside a list), and stops at the first that
  // does not.

  private def numbers(in: Tokenizer, isList: Boolean): Array[Float] =
    if isList then in.readFloats(floats, rests) else if in.readFloat(floats) then in.advance()
    floats.drain()

  private def integers(name: String, at: SourcePos, in: Tokenizer, isList: Boolean): Array[Int] =
    in.sawFraction = false
    if isList then in.readInts(ints) else if in.readInt(ints) then in.advance()
    if in.sawFraction then
      warn(Problem.warning(
        Code.ParameterType,
        at,
        s"values of `$name` must be integers; truncating fractions"
      ))
    ints.drain()

  private def texts(in: Tokenizer, isList: Boolean): Vector[String] =
    words(in, isList)(_.current == Token.Text)

  private def words(in: Tokenizer, isList: Boolean)(fits: Tokenizer => Boolean): Vector[String] =
    val values = Vector.newBuilder[String]
    if isList then in.advance()
    var continues = fits(in)
    while continues do
      values += in.text
      in.advance()
      continues = isList && fits(in)
    values.result()

  private val Bools = Set("true", "false")

  private def count(p: Param): Int =
    p.floats.length + p.ints.length + p.bools.size + p.strings.size

  /** The problem at the token where the values of `param` stop. */
  private def misfit(param: Param, in: Tokenizer, openAt: Option[SourcePos]): Problem =
    val name = s"`${param.name}`"
    def word = if in.current == Token.Word then in.text else ""
    val isNumber = in.isNumber
    val isQuotedNumber = in.current == Token.Text && in.text.toFloatOption.nonEmpty
    val isDirective = word.headOption.exists(_.isUpper)
    openAt match
      case Some(at) if in.current == Token.End =>
        Problem.error(
          Code.ParameterSyntax,
          at,
          s"$name has no closing `]` before the end of the file"
        )
      case None if in.current == Token.End || in.current == Token.Close || isDirective =>
        Problem.error(
          Code.ParameterSyntax,
          param.pos,
          s"$name must have a value",
          Some(example(param))
        )
      case _ if param.paramType == ParamType.Integer && isNumber =>
        Problem.error(
          Code.ParameterType,
          in.pos,
          s"values of $name must be 32-bit integers, found ${in.description}"
        )
      case _ =>
        val help =
          if isDirective then "a `]` may be missing before it"
          else if in.current == Token.Open then "lists can't be nested"
          else if isQuotedNumber then "write it without quotes"
          else example(param)
        val message = s"values of $name must be ${kindOf(param)}, found ${in.description}"
        Problem.error(Code.ParameterSyntax, in.pos, message, Some(help))

  private def kindOf(param: Param): String = param.paramType match
    case ParamType.Bool => "`true` or `false`"
    case ParamType.Integer => "integers"
    case ParamType.String => "quoted strings"
    case ParamType.Texture => "quoted texture names"
    case ParamType.Spectrum if param.strings.nonEmpty => "quoted names"
    case ParamType.Spectrum => "numbers or a quoted name"
    case _ => "numbers"

  private def example(param: Param): String =
    val values = param.paramType match
      case ParamType.Bool => "true"
      case ParamType.Integer => "3"
      case ParamType.Float => "0.5"
      case ParamType.String => "\"text\""
      case ParamType.Texture => "\"texture\""
      case ParamType.Point2 | ParamType.Vector2 => "[ 0 1 ]"
      case ParamType.Blackbody => "6500"
      case ParamType.Spectrum => "[ 400 0.2  700 0.8 ]"
      case _ => "[ 0.1 0.2 0.3 ]"
    s"for example \"${param.paramType.spelling} ${param.name}\" $values"

  /** A list must consist of whole pairs or triples; v2 and v3 ignore the rest, even if nothing else
    * is left. An empty list is reported.
    */
  def checkCount(param: Param): Param =
    val n = count(param)
    val size = param.paramType match
      case ParamType.Point2 | ParamType.Vector2 => 2
      case ParamType.Point3 | ParamType.Vector3 | ParamType.Normal => 3
      case ParamType.Rgb | ParamType.Xyz => 3
      case ParamType.Spectrum if param.strings.isEmpty => 2
      case _ => 1
    def help = Some(example(param))
    def fail(message: String) =
      throw SceneError(Problem.error(Code.ParameterSyntax, param.valuesAt, message, help))
    if n == 0 then
      warn(Problem.warning(
        Code.ParameterSyntax,
        param.valuesAt,
        s"`${param.name}` is an empty list"
      ))
    if param.paramType == ParamType.Texture && n > 1 then
      fail(s"`${param.name}` must be one texture, found $n names")
    val excess = n % size
    if excess == 0 then param
    else
      val group = if size == 2 then "pairs" else "triples"
      val noun = if n == 1 then "number" else "numbers"
      val message = s"values of `${param.name}` must come in $group, found $n $noun"
      if isV4() then fail(message)
      else
        val ignored =
          if n < size then if n == 1 then "it is" else "they are"
          else if excess == 1 then "the last is"
          else s"the last $excess are"
        warn(Problem.warning(
          Code.ParameterSyntax,
          param.valuesAt,
          s"$message; $ignored ignored",
          help
        ))
        param.truncated(n - excess)
