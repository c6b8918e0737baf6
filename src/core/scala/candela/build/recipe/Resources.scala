package candela.build.recipe

import candela.concurrency.Parallel
import candela.diagnostics.{Allowance, Code, Limit, SourcePos, Suggest}
import candela.io.Keep
import scala.collection.mutable

import candela.bsdf.Material
import candela.bsdf.composite.{ChosenMaterial, MixedMaterial}
import candela.color.ColorBasis
import candela.math.Position
import candela.scenefile.{Declaration, NameKind, Param}
import candela.settings.RenderSettings
import candela.textures.{FloatTexture, RgbTexture}

/** What statements of a scene file refer to: textures, materials and files.
  *
  * @param basis colour basis of the runtime scene
  * @param pool  executes divisible work
  * @param seed  the user's random seed; samplers have that of `settings`
  * @param plainBasis the three numbers of the scene, from which what all bases share is made
  */
final class Resources private (
    val basis: ColorBasis,
    val pool: Parallel,
    val seed: Int,
    shared: SharedResources,
    val plainBasis: ColorBasis,
    named: NamedMaterials.Statements
):
  def this(
      basis: ColorBasis,
      pool: Parallel = Parallel.Alone,
      seed: Int = 0,
      mayBeSpectral: Boolean = false,
      settings: RenderSettings = RenderSettings(),
      rules: Option[Rules] = None,
      origin: Position = Position.Origin,
      allowance: Allowance = Allowance(),
      textures: TextureStore = TextureStore.InMemory,
      cache: Keep = Keep.Nothing,
      isReadable: Boolean = true
  ) = this(
    basis,
    pool,
    seed,
    SharedResources(
      basis,
      mayBeSpectral,
      settings,
      rules,
      origin,
      allowance,
      textures,
      cache,
      isReadable,
      pool
    ),
    basis,
    NamedMaterials.Statements()
  )

  /** The same files, tables and named materials, for another basis; textures are yet to be defined.
    */
  def in(other: ColorBasis): Resources =
    new Resources(other, pool, seed, shared, plainBasis, named)

  /** Those of what is checked and never rendered: nothing is named yet, and pixels of images are
    * not read.
    */
  def unread: Resources =
    new Resources(basis, pool, seed, shared.unread, plainBasis, NamedMaterials.Statements())

  export shared.{unread as _, *}

  /** Whether this is the basis that is built first. */
  def isPlain: Boolean = basis eq plainBasis

  /** Where spectra are noted, if they decide how the scene is rendered. */
  def counting: Option[ColorCensus] = Option.when(mayBeSpectral && !basis.isSpectral)(census)

  val materials = NamedMaterials(named, shared.allowance.capped(Limit.Depth, 1024))

  private val floats = mutable.Map.empty[String, FloatTexture]
  private val colors = mutable.Map.empty[String, RgbTexture]

  // How many textures each evaluates, which would take a millisecond if there were more; all may be
  // within each other: evaluation goes as deep into the stack, for which threads have room
  private val sizes = Compositions(16384, deepest = shared.allowance.capped(Limit.Depth, 16384))

  private var undefined = Option.empty[LaterTextures]

  /** Defines textures once they are asked for: few of many colour bases see many of them. */
  def defineLater(textures: LaterTextures): Unit = undefined = Some(textures)

  // Textures see those before them
  private val defined = mutable.BitSet.empty
  private var visibleCount = Int.MaxValue
  private var depth = 0

  private def defineNow(kind: String, name: String): Unit =
    for
      textures <- undefined
      i = textures.indexOf(kind, name)
      if i >= 0 && i < visibleCount
    do
      def define(i: Int): Unit = if defined.add(i) then
        val outer = visibleCount
        visibleCount = i
        depth += 1
        try textures.define(i)
        finally
          depth -= 1
          visibleCount = outer
      // The stack has no room for thousands that each ask for another
      if depth == Resources.MaxDepth then (0 until i).foreach(define)
      define(i)

  /** Builds a texture and gives it a name. A texture of too many others is an error. */
  def defineFloat(name: String, at: SourcePos, problems: Findings)(make: => FloatTexture): Unit =
    val texture = sizes.composed("float", name)(make)(_.isConstant)
    floats(name) = accepted(name, at, problems)(texture, StandIns.number)

  def defineRgb(name: String, at: SourcePos, problems: Findings)(make: => RgbTexture): Unit =
    val texture = sizes.composed("spectrum", name)(make)(_.isConstant)
    colors(name) = accepted(name, at, problems)(texture, StandIns.color(basis))

  private def accepted[A](name: String, at: SourcePos, problems: Findings)(
      made: Either[String, A],
      standIn: => A
  ): A = made match
    case Right(texture) => texture
    case Left(why) =>
      problems.error(Code.Circle, at, s"texture `$name` is composed of $why")
      standIn

  /** Returns the texture that a parameter names, or a fallback after reporting a problem. */
  def floatTexture(p: Param, problems: Findings): Option[FloatTexture] =
    val texture = lookUp(p, floats, colors, "float", "spectrum", StandIns.Ones, problems)
    Some(texture.getOrElse(StandIns.number))

  /** As above. */
  def rgbTexture(p: Param, problems: Findings): Option[RgbTexture] =
    val texture = lookUp(p, colors, floats, "spectrum", "float", StandIns.Magentas, problems)
    Some(texture.getOrElse(StandIns.color(basis)))

  private def lookUp[T](
      p: Param,
      in: mutable.Map[String, T],
      others: mutable.Map[String, ?],
      kind: String,
      otherKind: String,
      standIn: String,
      problems: Findings
  ): Option[T] =
    val name = p.strings.headOption.getOrElse("")
    sizes.refer(kind, name)
    if !in.contains(name) then defineNow(kind, name)
    in.get(name).orElse {
      defineNow(otherKind, name)
      val isOther = others.contains(name)
      val message =
        if isOther then s"`${p.name}` must be a $kind texture, but `$name` is a $otherKind texture"
        else s"$kind texture `$name` is not defined"
      def names = undefined.fold(in.keys)(_.names(kind))
      def help = if isOther then None else Suggest.help(name, names)
      problems.unnamed(Code.Undefined, NameKind.Texture, p.valuesAt, message, standIn, help)
      None
    }

private[build] object Resources:
  /** Textures within each other that are defined when they are asked for. */
  private val MaxDepth = 50

/** Textures by their numbers, which are in the order of their statements. */
trait LaterTextures:
  /** −1: there is none.
    *
    * @param kind "float" or "spectrum"
    */
  def indexOf(kind: String, name: String): Int
  def define(index: Int): Unit
  def names(kind: String): Iterable[String]

/** Materials by the names that `MakeNamedMaterial` gave them, each built on first use.
  *
  * @param statements shared by all colour bases
  * @param deepest    number of materials within each other
  */
final class NamedMaterials(statements: NamedMaterials.Statements, deepest: Int):
  import NamedMaterials.*
  private def recipes = statements.recipes
  private val built = mutable.HashMap.empty[String, Material]
  private val open = mutable.HashSet.empty[String]
  // More lobes would take a millisecond each time; evaluation goes as deep into the stack
  private val sizes = Compositions(most = 1024, deepest)

  /** @param parts names of the materials that it refers to */
  def define(
      name: String,
      at: SourcePos,
      parts: Vector[String],
      make: Resources => Material
  ): Unit =
    recipes(name) = Named(at, parts, make)

  /** Returns the named material. An undefined one is reported as missing; one that refers to itself
    * is an error, as is one with too many parts.
    */
  def apply(name: String, at: SourcePos, resources: Resources, problems: Findings): Material =
    sizes.refer(Kind, name)
    if open(name) then
      problems.error(Code.Circle, at, s"material `$name` refers to itself")
      StandIns.material(resources.basis)
    else if recipes.contains(name) then
      if !built.contains(name) then build(name, resources, problems)
      built(name)
    else
      built.getOrElseUpdate(
        name, {
          problems.unnamed(
            Code.Undefined,
            NameKind.Material,
            at,
            s"material `$name` is not defined",
            StandIns.MagentaSurface,
            Suggest.help(name, recipes.keys)
          )
          StandIns.material(resources.basis)
        }
      )

  /** Builds a material after its parts, however deep they are nested. */
  private def build(name: String, resources: Resources, problems: Findings): Unit =
    val waiting = mutable.Stack(name)
    open += name
    while waiting.nonEmpty do
      val last = waiting.top
      val recipe = recipes(last)
      recipe.parts.find(p => recipes.contains(p) && !built.contains(p) && !open(p)) match
        case Some(part) =>
          open += part
          val _ = waiting.push(part)
        case None =>
          val result =
            try sizes.composed(Kind, last)(recipe.make(resources))(_ => false, chosen)
            finally open -= last
          built(last) = result match
            case Right(material) => material
            case Left(why) =>
              problems.error(Code.Circle, recipe.at, s"material `$last` is composed of $why")
              StandIns.material(resources.basis)
          val _ = waiting.pop()

object NamedMaterials:
  /** Of blends of too many parts one is evaluated at a time. */
  private def chosen(made: Material, why: String): Either[String, Material] = made match
    case blend: MixedMaterial => Right(ChosenMaterial(blend))
    case _ => Left(why)

  private val Kind = "material"
  private final case class Named(
      at: SourcePos,
      parts: Vector[String],
      make: Resources => Material
  )

  /** What is written of named materials. */
  final class Statements:
    private[NamedMaterials] val recipes = mutable.LinkedHashMap.empty[String, Named]
