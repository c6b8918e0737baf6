package candela.convert

import candela.diagnostics.{Code, SourcePos}
import scala.collection.mutable

import candela.color.Rgb
import candela.scenefile.*

import java.util.Locale

/** A statement during conversion: steps take its parameters and add those of the target dialect. */
final class Statement(val declaration: Declaration, val run: PassRun, rule: Rule):
  private val pending = mutable.LinkedHashMap.from(declaration.params.map(p => p.name -> p))
  private val added = mutable.ArrayBuffer.empty[Param]

  /** The name in the target dialect. */
  var targetName: String = rule.to

  def name: String = declaration.name

  /** The target dialect's name, for messages. */
  def target: String = run.pass.to.toString.toLowerCase(Locale.ROOT)

  /** The statement as a texture of the source dialect. */
  def asTexture(valueType: String): TextureDescription =
    TextureDescription(name, valueType, declaration, run.textureToWorld)

  /** Overrides the rule's target name. */
  def convertTo(name: String): Unit = targetName = name

  def contains(name: String): Boolean = pending.contains(name) || added.exists(_.name == name)

  /** Removes and returns a parameter. */
  def take(name: String): Option[Param] = pending.remove(name)

  /** Adds a source parameter for later steps. */
  def addSource(p: Param): Unit = pending(p.name) = p

  def hasAdded(t: ParamType): Boolean = added.exists(_.paramType == t)

  /** Returns a parameter without removing it. */
  def peek(name: String): Option[Param] = pending.get(name)

  /** Whether the scene file specifies the parameter. */
  def isSpecified(name: String): Boolean = declaration.params.exists(_.name == name)

  /** Adds a parameter under the given name, its value in the target dialect's form. */
  def add(name: String, p: Param): Unit =
    val adapted = run.values.adapt(p, name, declaration)
    adapted.foreach(a => added += Values.renamed(a, name))

  def addFloat(name: String, values: Float*)(using at: SourcePos = declaration.pos): Unit =
    added += Param(ParamType.Float, name, at, at, floats = values.toArray)
  def addInteger(name: String, values: Int*)(using at: SourcePos = declaration.pos): Unit =
    added += Param(ParamType.Integer, name, at, at, ints = values.toArray)
  def addBool(name: String, value: Boolean)(using at: SourcePos = declaration.pos): Unit =
    added += Param(ParamType.Bool, name, at, at, bools = Vector(value))
  def addString(name: String, values: String*)(using at: SourcePos = declaration.pos): Unit =
    added += Param(ParamType.String, name, at, at, strings = values.toVector)
  def addRgb(name: String, c: Rgb)(using at: SourcePos = declaration.pos): Unit =
    added += Param(ParamType.Rgb, name, at, at, floats = Array(c.r, c.g, c.b))
  def addTexture(name: String, texture: String)(using at: SourcePos = declaration.pos): Unit =
    added += Param(ParamType.Texture, name, at, at, strings = Vector(texture))
  def addRaw(p: Param): Unit = added += p

  def warn(code: Code, at: SourcePos, message: String): Unit = run.warn(code, at, message)

  // Constant values of parameters, if known.

  /** A constant number. */
  def numberOf(p: Param): Option[Float] = p.paramType match
    case ParamType.Float if p.floats.length == 1 => Some(p.floats(0))
    case ParamType.Integer if p.ints.length == 1 => Some(p.ints(0).toFloat)
    case ParamType.Texture =>
      run.texture(p.strings.head, "float").filter(_.texture.name == "constant").flatMap: t =>
        t.texture.param("value").fold(Some(1f))(numberOf)
    case _ => run.values.color(p, declaration).filter(Values.isGray).map(_.r)

  /** A constant colour. */
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

  /** The statement in the target dialect. Defaults from `Attribute` may not apply to this type. */
  def result(): Declaration =
    for step <- rule.steps do step.run(this)
    for note <- rule.note if targetName == rule.to && rule.differs(run.ends) do
      val source = s"${declaration.category} \"$name\""
      val message = s"$source is converted to \"$targetName\" in $target: $note"
      warn(Code.Inexpressible, declaration.pos, message)
    for p <- pending.values if !p.isDefault do run.ignore(p, name)
    val (implied, converted) = added.toVector.partition(_.pos == declaration.pos)
    val ordered = converted.sortBy(p => (p.pos.line, p.pos.column)) ++ implied
    // v2 and v3 have no `Attribute`
    val written = if run.pass.to == Dialect.V4 then ordered else ordered.map(_.asOwn)
    declaration.copy(name = targetName, params = written, colorSpace = "srgb")
