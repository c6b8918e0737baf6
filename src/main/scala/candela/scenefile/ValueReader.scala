package candela.scenefile

import candela.base.{FloatBuffer, IntBuffer, Problem, SceneError, SourcePos}

/** Reads the values of parameters, and checks that they are what the parameter's type says.
  *
  * @param warn hears of what is odd, yet readable
  */
final class ValueReader(warn: Problem => Unit):
  private val floats = FloatBuffer()
  private val ints = IntBuffer()

  /** The value, or the list in brackets, from the current token on.
    *
    * @param at where the parameter begins
    */
  def read(paramType: ParamType, name: String, at: SourcePos, in: Tokenizer): Param =
    val open = Option.when(in.current == Token.Open)(in.at)
    val valuesAt = if open.nonEmpty then in.nextAt else in.at
    val isText = if open.nonEmpty then in.nextIsText else in.current == Token.Text
    val isList = open.nonEmpty
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
        Param(paramType, name, at, valuesAt, floats = numbers(in, isList))
    open match
      case Some(_) if in.current == Token.Close => in.advance()
      case Some(_) => throw SceneError(misfit(param, in, open))
      case None => if count(param) == 0 then throw SceneError(misfit(param, in, None))
    checkCount(param)
    param

  // Each of these reads as many values as fit (one, if it is no list), and stops at what does not.

  private def numbers(in: Tokenizer, isList: Boolean): Array[Float] =
    if isList then in.readFloats(floats) else if in.readFloat(floats) then in.advance()
    floats.take()

  private def integers(name: String, at: SourcePos, in: Tokenizer, isList: Boolean): Array[Int] =
    in.sawFraction = false
    if isList then in.readInts(ints) else if in.readInt(ints) then in.advance()
    if in.sawFraction then
      warn(Problem.warning(at, s"`$name` takes whole numbers; fractions are cut off"))
    ints.take()

  private def texts(in: Tokenizer, isList: Boolean): Vector[String] =
    words(in, isList)(_.current == Token.Text)

  private def words(in: Tokenizer, isList: Boolean)(fits: Tokenizer => Boolean): Vector[String] =
    val values = Vector.newBuilder[String]
    if isList then in.advance()
    var more = fits(in)
    while more do
      values += in.text
      in.advance()
      more = isList && fits(in)
    values.result()

  private val Bools = Set("true", "false")

  private def count(p: Param): Int =
    p.floats.length + p.ints.length + p.bools.size + p.strings.size

  /** What is wrong where the values of `param` stop. */
  private def misfit(param: Param, in: Tokenizer, openAt: Option[SourcePos]): Problem =
    val name = s"`${param.name}`"
    def word = if in.current == Token.Word then in.text else ""
    val isNumber = in.numberHere.nonEmpty
    val isQuotedNumber = in.current == Token.Text && in.text.toFloatOption.nonEmpty
    val isDirective = word.headOption.exists(_.isUpper)
    openAt match
      case Some(at) if in.current == Token.End =>
        Problem.error(at, s"the values of $name have no closing `]` before the end of the file")
      case None if in.current == Token.End || in.current == Token.Close || isDirective =>
        Problem.error(param.at, s"$name has no value", Some(example(param)))
      case _ if param.paramType == ParamType.Integer && isNumber =>
        Problem.error(in.at, s"${in.shown} is beyond the range of a 32-bit integer")
      case _ =>
        val help =
          if isDirective then "is a `]` missing before it?"
          else if in.current == Token.Open then "lists do not nest"
          else if isQuotedNumber then "write it without quotes"
          else example(param)
        Problem.error(in.at, s"$name takes ${kindOf(param)}, but here is ${in.shown}", Some(help))

  private def kindOf(param: Param): String = param.paramType match
    case ParamType.Bool => "`true` or `false`"
    case ParamType.Integer => "whole numbers"
    case ParamType.String => "text in quotes"
    case ParamType.Texture => "a texture's name in quotes"
    case ParamType.Spectrum if param.strings.nonEmpty => "names in quotes"
    case ParamType.Spectrum => "numbers or a name in quotes"
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

  /** A list must be a whole number of pairs or triples, and have a value. */
  private def checkCount(param: Param): Unit =
    val n = count(param)
    val size = param.paramType match
      case ParamType.Point2 | ParamType.Vector2 => 2
      case ParamType.Point3 | ParamType.Vector3 | ParamType.Normal => 3
      case ParamType.Rgb | ParamType.Xyz => 3
      case ParamType.Spectrum if param.strings.isEmpty => 2
      case _ => 1
    def fail(message: String) =
      throw SceneError(Problem.error(param.valuesAt, message, Some(example(param))))
    if n == 0 then warn(Problem.warning(param.valuesAt, s"`${param.name}` has an empty list"))
    if n % size != 0 then
      val group = if size == 2 then "pairs" else "triples"
      val noun = if n == 1 then "number" else "numbers"
      fail(s"`${param.name}` takes $group, but has $n $noun")
    if param.paramType == ParamType.Texture && n > 1 then
      fail(s"`${param.name}` takes one texture, but has $n names")
