package candela.convert

import scala.collection.mutable

import candela.base.SourcePos
import candela.color.Rgb
import candela.scenefile.*

/** A statement on its way into another dialect: steps take parameters from it, and add those of the
  * other dialect.
  */
final class Statement(val declaration: Declaration, val run: PassRun, rule: Rule):
  private val open = mutable.LinkedHashMap.from(declaration.params.map(p => p.name -> p))
  private val made = mutable.ArrayBuffer.empty[Param]

  /** The name in the other dialect. */
  var becomes: String = rule.to

  def name: String = declaration.name

  /** How messages call the dialect that is written. */
  def target: String = run.pass.to.toString.toLowerCase

  /** Chooses another name than the rule's. */
  def become(name: String): Unit = becomes = name

  def has(name: String): Boolean = open.contains(name) || made.exists(_.name == name)

  /** The parameter, which is not looked at again. */
  def take(name: String): Option[Param] = open.remove(name)

  /** Gives the statement another parameter, for later steps. */
  def put(p: Param): Unit = open(p.name) = p

  def hasMade(t: ParamType): Boolean = made.exists(_.paramType == t)

  /** The parameter, which stays. */
  def look(name: String): Option[Param] = open.get(name)

  /** Does the scene file say it? */
  def wasGiven(name: String): Boolean = declaration.params.exists(_.name == name)

  /** Adds a parameter under a name, its value in the way of the other dialect. */
  def add(name: String, p: Param): Unit =
    val adapted = run.values.adapt(p, name, declaration)
    adapted.foreach(a => made += Values.renamed(a, name))

  def addFloat(name: String, values: Float*)(using at: SourcePos = declaration.at): Unit =
    made += Param(ParamType.Float, name, at, at, floats = values.toArray)
  def addInteger(name: String, values: Int*)(using at: SourcePos = declaration.at): Unit =
    made += Param(ParamType.Integer, name, at, at, ints = values.toArray)
  def addBool(name: String, value: Boolean)(using at: SourcePos = declaration.at): Unit =
    made += Param(ParamType.Bool, name, at, at, bools = Vector(value))
  def addString(name: String, values: String*)(using at: SourcePos = declaration.at): Unit =
    made += Param(ParamType.String, name, at, at, strings = values.toVector)
  def addRgb(name: String, c: Rgb)(using at: SourcePos = declaration.at): Unit =
    made += Param(ParamType.Rgb, name, at, at, floats = Array(c.r, c.g, c.b))
  def addTexture(name: String, texture: String)(using at: SourcePos = declaration.at): Unit =
    made += Param(ParamType.Texture, name, at, at, strings = Vector(texture))
  def addRaw(p: Param): Unit = made += p

  def warn(at: SourcePos, message: String): Unit = run.warn(at, message)

  // What parameters hold, if that can be told

  /** A number that is the same everywhere. */
  def numberOf(p: Param): Option[Float] = p.paramType match
    case ParamType.Float if p.floats.length == 1 => Some(p.floats(0))
    case ParamType.Integer if p.ints.length == 1 => Some(p.ints(0).toFloat)
    case ParamType.Texture =>
      run.texture(p.strings.head, "float").filter(_.texture.name == "constant").flatMap: t =>
        t.texture.param("value").fold(Some(1f))(numberOf)
    case _ => run.values.color(p, declaration).filter(Values.isGray).map(_.r)

  /** A colour that is the same everywhere. */
  def colorOf(p: Param): Option[Rgb] = p.paramType match
    case ParamType.Texture =>
      run.texture(p.strings.head, "spectrum").filter(_.texture.name == "constant").flatMap: t =>
        t.texture.param("value").fold(Some(Rgb.White))(colorOf)
    case _ => run.values.color(p, declaration)

  def takeBool(name: String, default: Boolean): Boolean =
    take(name).flatMap(_.bools.headOption).getOrElse(default)
  def takeString(name: String, default: String): String =
    take(name).flatMap(_.strings.headOption).getOrElse(default)
  def takeInteger(name: String, default: Int): Int =
    take(name).flatMap(_.ints.headOption).getOrElse(default)
  def takeNumber(name: String, default: Float): Float =
    take(name).flatMap(numberOf).getOrElse(default)
  def takeColor(name: String, default: Rgb): Rgb =
    take(name).flatMap(colorOf).getOrElse(default)

  /** The statement of the other dialect. Defaults that came from `Attribute` may fit none here. */
  def result(): Declaration =
    for step <- rule.steps do step.run(this)
    for note <- rule.note if becomes == rule.to do
      warn(declaration.at, s"${declaration.category} \"$name\" is \"$becomes\" in $target: $note")
    for p <- open.values if !p.isDefault do
      warn(p.at, s"`${p.name}` is no parameter of \"$name\": it is left out")
    val (new_, old) = made.toVector.partition(_.at == declaration.at)
    val ordered = old.sortBy(p => (p.at.line, p.at.column)) ++ new_
    declaration.copy(name = becomes, params = ordered, colorSpace = "srgb")
