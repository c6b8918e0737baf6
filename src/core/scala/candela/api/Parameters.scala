package candela.api

import candela.base.RestBuffer
import candela.diagnostics.SourcePos
import candela.scenefile.{Param, ParamType}

import scala.annotation.varargs

/** Parameters of a statement: names with values of a type, as in a file of pbrt-v4. Immutable: each
  * method returns a new value. Names and values are checked when the scene is read or prepared.
  * {{{
  * Parameters().rgb("reflectance", 0.8, 0.2, 0.1).number("roughness", 0.3)
  * }}}
  * Arrays are copied.
  */
final class Parameters private (private val makers: Vector[SourcePos => Param]):
  private def plus(make: SourcePos => Param): Parameters = Parameters(makers :+ make)

  private def floats(kind: ParamType, name: String, values: Array[Float]): Parameters =
    val copy = values.clone
    plus(Param.floats(kind, name, _, copy))

  /** Positions keep Double precision. */
  private def doubles(kind: ParamType, name: String, values: Array[Double]): Parameters =
    val rounded = values.map(_.toFloat)
    val rests =
      if kind == ParamType.Point3 then RestBuffer.of(values.length)(values(_))
      else Array.emptyFloatArray
    plus(Param.floats(kind, name, _, rounded, rests))

  /** `"float name" value` */
  def number(name: String, value: Double): Parameters =
    doubles(ParamType.Float, name, Array(value))

  /** `"float name" [ … ]` */
  def numbers(name: String, values: Array[Float]): Parameters =
    floats(ParamType.Float, name, values)

  /** `"integer name" [ … ]` */
  @varargs def integer(name: String, values: Int*): Parameters = integers(name, values.toArray)

  /** `"integer name" [ … ]`, such as the corners of a mesh's triangles. */
  def integers(name: String, values: Array[Int]): Parameters =
    val copy = values.clone
    plus(at => Param(ParamType.Integer, name, at, at, ints = copy))

  /** `"bool name" true` */
  def bool(name: String, value: Boolean): Parameters = plus(Param.bool(name, _, value))

  /** `"string name" "…"` */
  @varargs def text(name: String, values: String*): Parameters =
    plus(Param.string(name, _, values*))

  /** `"texture name" "…"`: a texture that was defined before. */
  def texture(name: String, texture: String): Parameters =
    plus(Param.texture(name, _, texture))

  /** `"point2 name" [ … ]`: pairs, such as texture coordinates. */
  def points2(name: String, values: Array[Float]): Parameters =
    floats(ParamType.Point2, name, values)

  /** `"point3 name" [ x y z ]` */
  def point(name: String, x: Double, y: Double, z: Double): Parameters =
    doubles(ParamType.Point3, name, Array(x, y, z))

  /** `"point3 name" [ … ]`: triples, such as the corners of a mesh. */
  def points(name: String, values: Array[Float]): Parameters =
    floats(ParamType.Point3, name, values)

  /** `"point3 name" [ … ]`, of coordinates that need more digits than Floats have. */
  def points(name: String, values: Array[Double]): Parameters =
    doubles(ParamType.Point3, name, values)

  /** `"vector3 name" [ x y z ]` */
  def vector(name: String, x: Double, y: Double, z: Double): Parameters =
    doubles(ParamType.Vector3, name, Array(x, y, z))

  /** `"vector3 name" [ … ]`: triples, such as the tangents of a mesh. */
  def vectors(name: String, values: Array[Float]): Parameters =
    floats(ParamType.Vector3, name, values)

  /** `"normal name" [ … ]`: triples. */
  def normals(name: String, values: Array[Float]): Parameters =
    floats(ParamType.Normal, name, values)

  /** `"rgb name" [ r g b ]`: linear, in the current colour space, which is sRGB unless changed. */
  def rgb(name: String, r: Double, g: Double, b: Double): Parameters =
    doubles(ParamType.Rgb, name, Array(r, g, b))

  /** `"rgb name" [ … ]`: triples. */
  def rgbs(name: String, values: Array[Float]): Parameters = floats(ParamType.Rgb, name, values)

  /** `"blackbody name" kelvin` */
  def blackbody(name: String, kelvin: Double): Parameters =
    doubles(ParamType.Blackbody, name, Array(kelvin))

  /** `"spectrum name" "metal-Cu-eta"`: a named spectrum, or a file of one. */
  def spectrum(name: String, named: String): Parameters =
    plus(at => Param(ParamType.Spectrum, name, at, at, strings = Vector(named)))

  /** `"spectrum name" [ … ]`: pairs of wavelength in nanometres and value. */
  def spectrum(name: String, pairs: Array[Double]): Parameters =
    doubles(ParamType.Spectrum, name, pairs)

  /** As `Parameters(rgb reflectance, float roughness)`. */
  override def toString: String =
    val names = located(SourcePos.Nowhere).map(p => s"${p.paramType.spelling} ${p.name}")
    Shown("Parameters", names*)

  private[api] def located(place: SourcePos): Vector[Param] = makers.map(_(place))

object Parameters:
  /** None. */
  def apply(): Parameters = new Parameters(Vector.empty)

  /** None, for Java and Kotlin. */
  def create(): Parameters = apply()

  private def apply(makers: Vector[SourcePos => Param]): Parameters = new Parameters(makers)
