package candela.scenefile

import candela.base.SourcePos

/** The three published scene formats; v1 files read as v2. */
enum Dialect:
  case V2, V3, V4

/** What a parameter's list holds, after the type's many spellings are folded together. */
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

  /** `point`, `point3`: triples; likewise for vectors and normals. */
  case Point3 extends ParamType("point3")
  case Vector3 extends ParamType("vector3")
  case Normal extends ParamType("normal")

  /** `rgb`, `color`: triples of linear sRGB. */
  case Rgb extends ParamType("rgb")
  case Xyz extends ParamType("xyz")

  /** A temperature in kelvin (and, in v2 and v3, a scale after each). */
  case Blackbody extends ParamType("blackbody")

  /** Wavelength–value pairs in `floats`; or a file's or measured spectrum's name in `strings`. */
  case Spectrum extends ParamType("spectrum")

/** One `"type name" [ values ]` of a statement, as written.
  *
  * @param at       where the quoted type and name begin
  * @param valuesAt where the values begin
  * @param floats   the numbers of every numeric type but `integer` (empty otherwise); `bools`,
  *                 `ints` and `strings` likewise for theirs
  * @param isDefault came from an `Attribute` statement, which speaks to many: it may fit none here
  */
final class Param(
    val paramType: ParamType,
    val name: String,
    val at: SourcePos,
    val valuesAt: SourcePos,
    val floats: Array[Float] = Array.emptyFloatArray,
    val ints: Array[Int] = Array.emptyIntArray,
    val bools: Vector[Boolean] = Vector.empty,
    val strings: Vector[String] = Vector.empty,
    val isDefault: Boolean = false
):
  def withStrings(values: Vector[String]): Param =
    Param(paramType, name, at, valuesAt, floats, ints, bools, values, isDefault)

  def asDefault: Param = Param(paramType, name, at, valuesAt, floats, ints, bools, strings, true)

/** A quoted implementation name with its parameters: `"perspective" "float fov" 45`.
  *
  * @param category what kind of thing is declared, for messages: `Shape`, `Material`, `Camera`, …
  * @param at       where the quoted name stands
  * @param folder   the folder of the scene (main) file, against which file names in parameters
  *                 resolve
  * @param colorSpace of the parameters' colours, as v4 calls it
  */
final case class Declaration(
    category: String,
    name: String,
    params: Vector[Param],
    at: SourcePos,
    folder: java.nio.file.Path,
    colorSpace: String = "srgb"
):
  def param(name: String): Option[Param] = params.find(_.name == name)
