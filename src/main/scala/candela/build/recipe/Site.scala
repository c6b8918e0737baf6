package candela.build.recipe

import scala.collection.mutable

import candela.base.{Problem, SceneError, Severity, SourcePos}
import candela.bsdf.{DiffuseMaterial, Material}
import candela.color.{ColorBasis, Rgb}
import candela.image.{Image, StoredImage}
import candela.math.Transform
import candela.scenefile.{Declaration, Dialect, Excerpts, NameKind}
import candela.textures.{ConstantFloat, ConstantRgb, FloatTexture, RgbTexture}

/** Where a recipe is being followed: the statement, the dialect, and what the scene has so far.
  *
  * @param toWorld the transform at the statement, for recipes that need to know it
  */
final class Site(
    val declaration: Declaration,
    val dialect: Dialect,
    val resources: Resources,
    val problems: Findings,
    val toWorld: Transform = Transform.Identity
):
  def in(other: Dialect): Site = Site(declaration, other, resources, problems, toWorld)

  def warn(message: String, help: Option[String] = None): Unit =
    problems.warn(declaration.at, message, help)
  def error(message: String, help: Option[String] = None): Unit =
    problems.error(declaration.at, message, help)

  /** The statement asks for what is not there. */
  def missing(message: String, standIn: String, help: Option[String] = None): Unit =
    problems.missing(declaration.at, message, standIn, help)

/** Gathers what is wrong with a description, so that one run can name it all.
  *
  * @param keepGoing what is missing is replaced, with a warning
  * @param lost      the names that statements which could not be read may have made: that others
  *                  use them is no error of its own
  * @param earlier   errors that were found already
  */
final class Findings(
    keepGoing: Boolean = false,
    lost: Set[NameKind] = Set.empty,
    earlier: Vector[Problem] = Vector.empty
):
  private val all = mutable.LinkedHashSet.from(earlier)
  private var errors = earlier.count(_.severity == Severity.Error)

  private def add(problem: Problem): Unit =
    if all.add(problem) && problem.severity == Severity.Error then errors += 1

  def warn(at: SourcePos, message: String, help: Option[String] = None): Unit =
    add(Problem.warning(at, message, help))

  def error(at: SourcePos, message: String, help: Option[String] = None): Unit =
    add(Problem.error(at, message, help))

  /** Something that the scene asks for is not there: an error, or a warning that says what takes
    * its place.
    */
  def missing(
      at: SourcePos,
      message: String,
      standIn: String,
      help: Option[String] = None
  ): Unit = add(Problem.missing(at, message, standIn, keepGoing, help))

  /** Likewise for a name that no statement made. */
  def unnamed(
      kind: NameKind,
      at: SourcePos,
      message: String,
      standIn: String,
      help: Option[String] = None
  ): Unit = if !lost(kind) then missing(at, message, standIn, help)

  def result: Vector[Problem] = Excerpts.fill(all.toVector)
  def hasErrors: Boolean = errors > 0

  /** Goes no further than errors allow: after them a scene would be built in vain.
    *
    * @throws SceneError with everything that was found
    */
  def stopAtErrors(): Unit = if hasErrors then throw SceneError(Problem.byPlace(result))

/** What takes the place of what is missing, where the user asked to keep going: magenta, which
  * nobody overlooks or takes for the scene's own.
  */
object StandIns:
  val Magenta: Rgb = Rgb(1f, 0f, 1f)

  val picture: StoredImage = Image(1, 1, Image.RgbNames, Array(Magenta.r, Magenta.g, Magenta.b))
  val number: FloatTexture = ConstantFloat(1f)
  def color(basis: ColorBasis): RgbTexture = ConstantRgb(basis.fromSrgb(Magenta))
  def material(basis: ColorBasis): Material = DiffuseMaterial(color(basis)).folded

  // The same in messages
  val Magentas = "magenta is used"
  val Ones = "1 is used all over"
  val MagentaSurface = "a magenta surface is used"
  val LeftOut = "it is left out"
  val Default = "the default is used"

  /** For a type that nobody knows. */
  def ofCategory(category: String): String = category match
    case "material" => MagentaSurface
    case "spectrum texture" => Magentas
    case "float texture" => Ones
    case "shape" | "light" | "area light" => LeftOut
    case _ => Default
