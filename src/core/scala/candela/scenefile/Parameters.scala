package candela.scenefile

import candela.diagnostics.{Code, Problem, SceneError, Suggest}
import scala.collection.mutable

/** Parses parameter lists: any number of `"type name" value` or `"type name" [ values ]`.
  *
  * @param evidence records the spellings of the types
  * @param warn receives warnings
  * @param continuation opens the file of the Include at the current token of a file, if it begins
  *   with parameters
  * @param isV4 whether the scene is v4's
  */
final class Parameters(
    evidence: DialectGuess,
    warn: Problem => Unit,
    continuation: Tokenizer => Option[Tokenizer] = _ => None,
    isV4: () => Boolean = () => true
):
  private val values = ValueReader(warn, isV4)
  private val keys = mutable.HashMap.empty[String, Parameters.Key]

  /** Tokenizers of the including files, innermost first. */
  private var outer = List.empty[Tokenizer]

  /** Runs `body`, which reads a file included by that of `in`. */
  def withOuter(in: Tokenizer)(body: => Unit): Unit =
    outer = in :: outer
    try body
    finally outer = outer.tail

  /** Reads the parameters from the current token on. Of duplicates the last is used, as in all
    * three renderers; but in v2 and v3 a texture is used instead of a constant.
    *
    * The parameter list of an included file's last statement continues in the including file: smoke
    * grids are often included as separate files, with the medium's other parameters after the
    * Include. A list may also begin or continue in an included file, as pbrt-v2 allows:
    * `Shape "trianglemesh" Include "vertices.pbrt"`.
    *
    * A parameter that can't be read is left out.
    */
  def list(in: Tokenizer): ParamsRead =
    val params = ParamList()
    withIncluded(in, params)
    var further = if in.current == Token.End then outer else Nil
    while further.nonEmpty do
      parametersHere(further.head, params)
      further = if further.head.current == Token.End then further.tail else Nil
    params.result

  private def withIncluded(in: Tokenizer, params: ParamList): Unit =
    parametersHere(in, params)
    var included = continuation(in)
    while included.nonEmpty do
      for file <- included do parametersHere(file, params)
      val isWhole = included.forall(_.current == Token.End)
      if isWhole then parametersHere(in, params)
      included = if isWhole then continuation(in) else None

  private def parametersHere(in: Tokenizer, params: ParamList): Unit =
    while in.current == Token.Text do
      try parameterHere(in, params)
      catch
        case e: SceneError =>
          params.faults ++= e.problems
          skipToParameter(in)

  private def parameterHere(in: Tokenizer, params: ParamList): Unit =
    val position = in.pos
    val key = keys.getOrElseUpdate(in.text, keyHere(in))
    in.advance()
    val param = values.read(key.paramType, key.name, position, in)
    params.lookup(param.name) match
      case None => params.add(param)
      case Some(earlier) =>
        val (ignored, effective) =
          if isTexture(earlier) && !isTexture(param) && !isV4() then (param, earlier)
          else (earlier, param)
        val message = s"`${param.name}` is repeated at ${effective.pos}; this value is ignored"
        warn(Problem.warning(Code.Redefined, ignored.pos, message))
        params.replace(earlier, effective)

  /** Skips what is left of a faulty value: all up to a type and a name, or to a directive. Skips
    * unreadable text, too.
    */
  private def skipToParameter(in: Tokenizer): Unit =
    def isParameter = in.current == Token.Text && Parameters.isKey(in.text)
    while in.current != Token.End && !in.startsName && !isParameter do
      try in.advance()
      catch case _: SceneError => ()

  private def isTexture(param: Param): Boolean = param.paramType == ParamType.Texture

  /** Reads one value or list from the current token on, without a preceding `"type name"`. */
  def value(paramType: ParamType, name: String, in: Tokenizer): Param =
    values.read(paramType, name, in.pos, in)

  private def keyHere(in: Tokenizer): Parameters.Key =
    def fail(message: String, help: String) =
      throw SceneError(Problem.error(Code.ParameterSyntax, in.pos, message, Some(help)))
    val types = Parameters.Types
    Parameters.words(in.text) match
      case Array(spelling, name, _*) if types.contains(spelling) =>
        evidence.uses("type", spelling, in.pos)
        Parameters.Key(types(spelling), name)
      case Array(spelling, _, _*) =>
        fail(s"unknown parameter type `$spelling`", Suggest.help(spelling, types.keys).get)
      case Array(word) if types.contains(word) =>
        fail(s"${in.description} is a parameter type without a name", s"for example \"$word name\"")
      case Array(word) =>
        fail(s"parameter ${in.description} must have a type", s"for example \"float $word\"")
      case _ => fail("expected a parameter, found an empty string", "for example \"float fov\" 45")

object Parameters:
  private final case class Key(paramType: ParamType, name: String)

  private def words(text: String): Array[String] = text.split("[ \t]+").filter(_.nonEmpty)

  /** Whether it is a type and a name. */
  private def isKey(text: String): Boolean = words(text) match
    case Array(spelling, _, _*) => Types.contains(spelling)
    case _ => false

  /** The spellings of all dialects. */
  private val Types: Map[String, ParamType] =
    ParamType.values.map(t => t.spelling -> t).toMap ++ Map(
      "point" -> ParamType.Point3,
      "vector" -> ParamType.Vector3,
      "normal3" -> ParamType.Normal,
      "color" -> ParamType.Rgb
    )

/** The parameters of a statement.
  *
  * @param faults what is wrong with those that are left out
  */
final case class ParamsRead(params: Vector[Param], faults: Vector[Problem])

/** Parameters, of each name one. */
private final class ParamList:
  var faults: Vector[Problem] = Vector.empty
  private var params = Vector.empty[Param]
  private var table: mutable.LinkedHashMap[String, Param] | Null = null

  def lookup(name: String): Option[Param] =
    val byName = table
    if byName == null then params.find(_.name == name) else byName.get(name)

  def add(param: Param): Unit =
    val byName = table
    if byName != null then byName(param.name) = param
    else
      params = params :+ param
      if params.size > ParamList.MaxSearched then
        table = mutable.LinkedHashMap.from(params.map(p => p.name -> p))

  /** What is used is the last of all. */
  def replace(earlier: Param, effective: Param): Unit =
    val byName = table
    if byName == null then params = params.filterNot(_ eq earlier) :+ effective
    else
      byName.remove(effective.name): Unit
      byName(effective.name) = effective

  def result: ParamsRead =
    val byName = table
    ParamsRead(if byName == null then params else byName.values.toVector, faults)

private object ParamList:
  /** Up to this number, a linear search is faster than a table. */
  val MaxSearched = 16
