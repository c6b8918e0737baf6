package candela.scenefile

import candela.diagnostics.SourcePos
import candela.io.SceneFolder
import candela.math.Position

import java.util.Arrays

/** Published scene formats; files of pbrt-v1 read as v2. */
enum Dialect:
  case V2, V3, V4

  /** Mitsuba 3's, whose files are described by the statements of pbrt-v4, and more. */
  case Mitsuba

  /** That of glTF models, likewise. */
  case Gltf

  /** The dialect whose statements describe it. */
  def base: Dialect = if Dialect.ofOthers(this) then V4 else this

object Dialect:
  /** Those of pbrt's files, oldest first. */
  val ofPbrt: Vector[Dialect] = Vector(V2, V3, V4)

  /** Those of formats that statements of pbrt-v4, and more, describe. */
  val ofOthers: Set[Dialect] = Set(Mitsuba, Gltf)

/** Element type of a parameter, with its dialects' spellings unified. */
enum ParamType(val spelling: String):
  case Float extends ParamType("float")
  case Integer extends ParamType("integer")
  case Bool extends ParamType("bool")
  case String extends ParamType("string")

  /** Texture name. */
  case Texture extends ParamType("texture")

  /** `point2`, `vector2`: pairs. */
  case Point2 extends ParamType("point2")
  case Vector2 extends ParamType("vector2")

  /** `point`, `point3`: triples; vectors and normals too. */
  case Point3 extends ParamType("point3")
  case Vector3 extends ParamType("vector3")
  case Normal extends ParamType("normal")

  /** `rgb`, `color`: triples of linear sRGB. */
  case Rgb extends ParamType("rgb")
  case Xyz extends ParamType("xyz")

  /** Temperature in kelvin (in v2 and v3 each followed by a scale). */
  case Blackbody extends ParamType("blackbody")

  /** Wavelength–value pairs in `floats`; or the name of a file or measured spectrum in `strings`.
    */
  case Spectrum extends ParamType("spectrum")

/** One `"type name" [ values ]` of a statement, as written.
  *
  * @param pos        position of the quoted type and name
  * @param valuesAt   position of the first value
  * @param floats     values of numeric types except `integer`, otherwise empty; `bools`, `ints` and
  *   `strings` hold the values of their types
  * @param rests      what the values of `floats` lack of those written, if coordinates are so large
  *   that Floats are coarse; otherwise empty
  * @param colorSpace name of its colour space, if not that of the declaration
  * @param isDefault  whether it comes from an `Attribute` statement, which applies to many
  *   declarations, not all of which know it
  */
final class Param(
    val paramType: ParamType,
    val name: String,
    val pos: SourcePos,
    val valuesAt: SourcePos,
    val floats: Array[Float] = Array.emptyFloatArray,
    val ints: Array[Int] = Array.emptyIntArray,
    val bools: Vector[Boolean] = Vector.empty,
    val strings: Vector[String] = Vector.empty,
    val isDefault: Boolean = false,
    val colorSpace: Option[String] = None,
    val rests: Array[Float] = Array.emptyFloatArray
):
  /** A number of `floats`, with its rest. */
  def number(i: Int): Double =
    if rests.length == 0 then floats(i) else floats(i).toDouble + rests(i)

  /** The triple from the number `i` on. */
  def position(i: Int): Position = Position(number(i), number(i + 1), number(i + 2))

  /** Whether another one has the same numbers, and neither has a name. */
  def isAlike(p: Param): Boolean =
    isOfKind(p) && bools == p.bools && Arrays.equals(ints, p.ints) &&
      Arrays.equals(floats, p.floats) && Arrays.equals(rests, p.rests)

  /** Likewise, whatever the numbers. */
  private[scenefile] def isOfKind(p: Param): Boolean =
    strings.isEmpty && p.strings.isEmpty && paramType == p.paramType && name == p.name &&
      isDefault == p.isDefault && colorSpace == p.colorSpace

  private def copy(
      paramType: ParamType = paramType,
      name: String = name,
      floats: Array[Float] = floats,
      strings: Vector[String] = strings,
      isDefault: Boolean = isDefault,
      colorSpace: Option[String] = colorSpace,
      rests: Array[Float] = rests
  ): Param =
    Param(
      paramType, name, pos, valuesAt, floats, ints, bools, strings, isDefault, colorSpace, rests
    )

  def renamed(name: String): Param = copy(name = name)

  def withStrings(values: Vector[String]): Param = copy(strings = values)

  /** In the colour space of the declaration. */
  def withFloats(values: Array[Float]): Param =
    copy(floats = values, colorSpace = None, rests = Array.emptyFloatArray)

  /** With each of its numbers changed. */
  def mapped(change: Float => Float): Param = Param(
    paramType,
    name,
    pos,
    valuesAt,
    floats.map(change),
    ints.map(i => if change(i.toFloat) == i.toFloat then i else change(i.toFloat).toInt),
    bools,
    strings,
    isDefault,
    colorSpace
  )

  /** With the first `count` of its numbers. */
  def truncated(count: Int): Param = copy(floats = floats.take(count), rests = rests.take(count))

  /** With another name and type of numbers, in the colour space of the declaration. */
  def renamed(other: String, otherType: ParamType): Param =
    copy(paramType = otherType, name = other, colorSpace = None)

  /** As written in the declaration itself. */
  def asOwn: Param = if isDefault then copy(isDefault = false) else this

  /** As given by an `Attribute` statement in a colour space. */
  def asDefault(space: String): Param =
    copy(isDefault = true, colorSpace = Option.when(paramType == ParamType.Rgb)(space))

object Param:
  def float(name: String, at: SourcePos, values: Float*): Param =
    Param(ParamType.Float, name, at, at, floats = values.toArray)
  def int(name: String, at: SourcePos, values: Int*): Param =
    ints(name, at, values.toArray)
  def ints(name: String, at: SourcePos, values: Array[Int]): Param =
    Param(ParamType.Integer, name, at, at, ints = values)
  def bool(name: String, at: SourcePos, value: Boolean): Param =
    Param(ParamType.Bool, name, at, at, bools = Vector(value))
  def string(name: String, at: SourcePos, values: String*): Param =
    Param(ParamType.String, name, at, at, strings = values.toVector)
  def texture(name: String, at: SourcePos, texture: String): Param =
    Param(ParamType.Texture, name, at, at, strings = Vector(texture))
  def floats(
      kind: ParamType,
      name: String,
      at: SourcePos,
      values: Array[Float],
      rests: Array[Float] = Array.emptyFloatArray
  ): Param =
    Param(kind, name, at, at, floats = values, rests = rests)

/** A quoted implementation name with its parameters: `"perspective" "float fov" 45`.
  *
  * @param category statement, for messages: `Shape`, `Material`, `Camera`, …
  * @param pos position of the quoted name
  * @param folder folder of the main scene file; file names in parameters are relative to it
  * @param colorSpace v4's name for the colour space of the parameters
  * @param dialect its dialect, if not that of the scene: a scene of another format is described by
  *   the nearest types of any
  * @param isFaulty whether some parameters could not be read: only its type is checked
  */
final case class Declaration(
    category: String,
    name: String,
    params: Vector[Param],
    pos: SourcePos,
    folder: SceneFolder,
    colorSpace: String = "srgb",
    dialect: Option[Dialect] = None,
    isFaulty: Boolean = false
):
  def param(name: String): Option[Param] =
    // Millions of shapes are asked for each of their parameters
    var i = 0
    while i < params.size && params(i).name != name do i += 1
    if i < params.size then Some(params(i)) else None

  /** Whether another statement means the same wherever both stand: they are of the same type, and
    * have equal numbers and no names.
    */
  def isAlike(d: Declaration): Boolean =
    (this eq d) || isOfType(d) && corresponds(d)(_.isAlike(_))

  /** Likewise, but for the numbers of one parameter. */
  def isAlikeBut(parameter: String, d: Declaration): Boolean =
    isOfType(d) && corresponds(d): (p, q) =>
      if p.name == parameter then p.isOfKind(q) else p.isAlike(q)

  /** Equal for all statements that are [[isAlikeBut]] this one. */
  def hashBut(parameter: String): Int =
    var hash = 31 * name.hashCode + colorSpace.hashCode
    var i = 0
    while i < params.size do
      val p = params(i)
      hash = 31 * hash + p.name.hashCode
      if p.name != parameter then
        hash = 31 * (31 * hash + Arrays.hashCode(p.floats)) + Arrays.hashCode(p.ints)
        hash = 31 * hash + p.bools.hashCode
      i += 1
    hash

  private inline def corresponds(d: Declaration)(inline isAlike: (Param, Param) => Boolean) =
    var i = 0
    while i < params.size && isAlike(params(i), d.params(i)) do i += 1
    i == params.size

  private def isOfType(d: Declaration): Boolean =
    name == d.name && category == d.category && colorSpace == d.colorSpace &&
      dialect == d.dialect && (folder eq d.folder) && params.size == d.params.size &&
      isFaulty == d.isFaulty

  /** Of what tells statements apart; there may be as many materials as shapes. */
  override def hashCode: Int =
    var hash = pos.hashCode
    var i = 0
    while i < params.size do
      hash = 31 * hash + params(i).hashCode
      i += 1
    hash

  /** Name of the colour space of a parameter. */
  def colorSpaceOf(p: Param): String = p.colorSpace.getOrElse(colorSpace)
