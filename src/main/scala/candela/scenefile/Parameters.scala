package candela.scenefile

import scala.collection.mutable

import candela.base.{Problem, SceneError, Suggest}

/** Reads parameter lists: `"type name" value` or `"type name" [ values ]`, any number of times.
  *
  * @param evidence learns which spellings of the types are used
  * @param warn     hears of what is odd, yet readable
  */
final class Parameters(evidence: DialectGuess, warn: Problem => Unit):
  private val values = ValueReader(warn)
  private val keys = mutable.HashMap.empty[String, Parameters.Key]

  /** What reads the files that include the present one, innermost first. */
  private var outer = List.empty[Tokenizer]

  /** Runs `body`, which reads a file that the one of `in` includes. */
  def within(in: Tokenizer)(body: => Unit): Unit =
    outer = in :: outer
    try body
    finally outer = outer.tail

  /** The parameters from the current token on. Of two with one name the last counts, as in all
    * three renderers. The last statement of an included file goes on where that was included: grids
    * of smoke often lie in files of their own, and what they are made of does not.
    */
  def list(in: Tokenizer): Vector[Param] =
    var params = parametersHere(in, Vector.empty)
    var further = if in.current == Token.End then outer else Nil
    while further.nonEmpty do
      params = parametersHere(further.head, params)
      further = if further.head.current == Token.End then further.tail else Nil
    params

  private def parametersHere(in: Tokenizer, before: Vector[Param]): Vector[Param] =
    var params = before
    while in.current == Token.Text do
      val at = in.at
      val key = keys.getOrElseUpdate(in.text, keyHere(in))
      in.advance()
      val param = values.read(key.paramType, key.name, at, in)
      params.find(_.name == param.name).foreach: earlier =>
        val message = s"`${param.name}` is given again at ${param.at}; this one has no effect"
        warn(Problem.warning(earlier.at, message))
        params = params.filterNot(_ eq earlier)
      params = params :+ param
    params

  /** One value or list from the current token on, where the file has no `"type name"` before it. */
  def value(paramType: ParamType, name: String, in: Tokenizer): Param =
    values.read(paramType, name, in.at, in)

  private def keyHere(in: Tokenizer): Parameters.Key =
    def fail(message: String, help: String) =
      throw SceneError(Problem.error(in.at, message, Some(help)))
    val types = Parameters.Types
    in.text.split("[ \t]+").filter(_.nonEmpty) match
      case Array(spelling, name, _*) if types.contains(spelling) =>
        evidence.uses("type", spelling)
        Parameters.Key(types(spelling), name)
      case Array(spelling, _, _*) =>
        fail(s"no parameter type is called `$spelling`", Suggest.help(spelling, types.keys).get)
      case Array(word) if types.contains(word) =>
        fail(s"${in.shown} is a parameter's type without its name", s"for example \"$word name\"")
      case Array(word) =>
        fail(s"${in.shown} is no parameter: its type is missing", s"for example \"float $word\"")
      case _ => fail("an empty text where a parameter was expected", "for example \"float fov\" 45")

object Parameters:
  private final case class Key(paramType: ParamType, name: String)

  /** Every dialect's spellings. */
  private val Types: Map[String, ParamType] =
    ParamType.values.map(t => t.spelling -> t).toMap ++ Map(
      "point" -> ParamType.Point3,
      "vector" -> ParamType.Vector3,
      "normal3" -> ParamType.Normal,
      "color" -> ParamType.Rgb
    )
