package candela.build.recipe

import candela.diagnostics.{Allowance, Code, Problem, SceneError, Severity, SourcePos}
import scala.collection.mutable

import candela.bsdf.{DiffuseMaterial, Material}
import candela.color.{ColorBasis, ColorSpace, Rgb}
import candela.image.{Image, StoredImage}
import candela.math.Transform
import candela.scenefile.{Declaration, Dialect, Excerpts, NameKind, NamedText, Param, Problems}
import candela.textures.{ConstantFloat, ConstantRgb, FloatTexture, RgbTexture}

/** Context of a recipe: the statement, the dialect and the scene's resources so far.
  *
  * @param dialect of pbrt's: that of the statement
  * @param toWorld the transform at the statement, for recipes that depend on it
  */
final class Site(
    val declaration: Declaration,
    val dialect: Dialect,
    val resources: Resources,
    val problems: Findings,
    val toWorld: Transform = Transform.Identity
):
  /** How the program of this dialect renders. */
  val rules: Rules = resources.rules.getOrElse(Rules.of(dialect))

  /** Is any of these the dialect here? Statements that a program adds are of pbrt-v4 alone. */
  def speaks(dialects: Set[Dialect]): Boolean =
    dialects(dialect) || dialects(rules.dialect) && !declaration.dialect.contains(Dialect.V4)

  /** How much the scene may use. */
  def allowance: Allowance = resources.allowance

  /** Colour space of a parameter. */
  def colorSpaceOf(p: Param): ColorSpace = space(declaration.colorSpaceOf(p))

  /** Colour space of the statement. */
  def colorSpace: ColorSpace = space(declaration.colorSpace)

  private def space(name: String) = ColorSpace.named(name).getOrElse(ColorSpace.Srgb)

  def in(other: Dialect): Site = Site(declaration, other, resources, problems, toWorld)

  /** The same statement with another type. */
  def of(otherType: String): Site =
    Site(declaration.copy(name = otherType), dialect, resources, problems, toWorld)

  def warn(code: Code, message: String, help: => Option[String] = None): Unit =
    problems.warn(code, declaration.pos, message, help)
  def error(code: Code, message: String, help: => Option[String] = None): Unit =
    problems.error(code, declaration.pos, message, help)

  /** Reports a statement that pbrt-v4 rejects and older versions skip with a message. */
  def unusable(code: Code, message: String, help: Option[String] = None): Unit =
    if dialect == Dialect.V4 then error(code, message, help)
    else warn(code, s"$message; ${StandIns.LeftOut}, as pbrt does", help)

  /** Reports a value that pbrt-v4 rejects; older versions use the default. */
  def unread(code: Code, p: Param, message: String, help: Option[String]): Unit =
    if dialect == Dialect.V4 then problems.error(code, p.pos, message, help)
    else problems.warn(code, p.pos, s"$message; it is ignored, as pbrt does", help)

  /** Reports that the statement refers to something missing. */
  def missing(
      code: Code,
      message: String,
      standIn: String,
      help: => Option[String] = None
  ): Unit =
    problems.missing(code, declaration.pos, message, standIn, help)

/** Collects the problems of a description, so that one run reports them all. Safe for threads.
  *
  * @param keepGoing if true, missing items are replaced, with a warning
  * @param lost      kinds of names that unreadable statements may have defined: references to them
  *                  are not reported
  * @param earlier   problems found before
  * @param text      of the scene, if it is no file
  */
final class Findings(
    keepGoing: Boolean = false,
    lost: Set[NameKind] = Set.empty,
    earlier: Vector[Problem] = Vector.empty,
    text: Option[NamedText] = None
):
  private val problems = mutable.LinkedHashSet.from(earlier)
  private val messages = mutable.HashSet.empty[(Severity, Option[SourcePos], String)]
  @volatile private var errors = earlier.count(_.severity == Severity.Error)
  private var warnings = 0
  private var reports = 0L

  /** How often something was reported, repeated or not. */
  def reported: Long = synchronized(reports)

  /** Help is looked for only if it is shown: what is missing may be missing a million times. */
  private def add(problem: Problem, help: => Option[String]): Unit = synchronized:
    reports += 1
    val isError = problem.severity == Severity.Error
    if isError || warnings <= Problems.MaxWarnings then
      if messages.add((problem.severity, problem.pos, problem.message)) then
        if isError then errors += 1 else warnings += 1
        if isError || warnings <= Problems.MaxWarnings then
          val isHelped = errors + warnings <= Problems.MaxHelped
          problems += (if isHelped then problem.withHelp(help) else problem): Unit
        else
          problems += Problem(
            Code.TooManyProblems,
            Severity.Warning,
            None,
            "more warnings are omitted"
          ): Unit
        if errors >= Problems.MaxErrors then
          val stop = s"building stopped after $errors errors"
          throw SceneError(Problem.byPlace(result) :+ Problem.general(Code.TooManyProblems, stop))

  def warn(code: Code, at: SourcePos, message: String, help: => Option[String] = None): Unit =
    add(Problem.warning(code, at, message), help)

  /** Warns of a choice that no statement need have made, at the statement that has. */
  def warn(code: Code, at: Option[SourcePos], message: String): Unit =
    add(Problem(code, Severity.Warning, at, message), None)

  def error(code: Code, at: SourcePos, message: String, help: => Option[String] = None): Unit =
    add(Problem.error(code, at, message), help)

  /** Reports a missing item: an error, or a warning that names its replacement. */
  def missing(
      code: Code,
      at: SourcePos,
      message: String,
      standIn: String,
      help: => Option[String] = None
  ): Unit = add(Problem.missing(code, at, message, standIn, keepGoing), help)

  /** Reports a reference to a name that no statement defines. */
  def unnamed(
      code: Code,
      kind: NameKind,
      at: SourcePos,
      message: String,
      standIn: String,
      help: => Option[String] = None
  ): Unit = if !lost(kind) then missing(code, at, message, standIn, help)

  /** Warns of what is wrong in what is not rendered. */
  def warnOf(unrendered: Findings): Unit =
    for
      p <- unrendered.problems.toVector
      at <- p.pos
      if synchronized(!messages((Severity.Error, p.pos, p.message)))
    do warn(p.code, at, p.message, p.help)

  def result: Vector[Problem] = Excerpts.fill(problems.toVector, Excerpts.sources(text))
  def hasErrors: Boolean = errors > 0

  /** Stops if there are errors: the scene can't be built.
    *
    * @throws SceneError with all problems found
    */
  def stopAtErrors(): Unit = if hasErrors then throw SceneError(Problem.byPlace(result))

/** Fallbacks for missing items if the user chose to keep going: magenta, which is hard to overlook
  * or to mistake for the scene's own.
  */
object StandIns:
  val Magenta: Rgb = Rgb(1f, 0f, 1f)

  val picture: StoredImage = Image(1, 1, Image.RgbNames, Array(Magenta.r, Magenta.g, Magenta.b))
  val number: FloatTexture = ConstantFloat(1f)
  def color(basis: ColorBasis): RgbTexture = ConstantRgb(basis.fromSrgb(Magenta))
  def material(basis: ColorBasis): Material = DiffuseMaterial(color(basis)).folded

  // Their descriptions in messages
  val Magentas = "using magenta"
  val Ones = "using the constant 1"
  val MagentaSurface = "using a magenta surface"
  val LeftOut = "skipped"
  val Default = "using the default"

  /** Replacement for an unknown type. */
  def ofCategory(category: String): String = category match
    case "material" => MagentaSurface
    case "spectrum texture" => Magentas
    case "float texture" => Ones
    case "shape" | "light" | "area light" => LeftOut
    case _ => Default

  /** The substitute of pbrt-v2 and v3 for an unknown type, after a warning. Forks of pbrt add
    * types, and the originals render their scenes, too.
    */
  def ofPbrt(category: String, dialect: Dialect): Option[String] =
    category match
      case _ if dialect == Dialect.V4 => None
      case "material" => Some("using \"matte\"")
      case "accelerator" => Some("using \"bvh\"")
      case "shape" | "light" | "area light" | "volume" | "medium" => Some(LeftOut)
      case _ => None
