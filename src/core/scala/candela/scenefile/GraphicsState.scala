package candela.scenefile

import candela.diagnostics.SourcePos
import scala.collection.mutable

import candela.math.Transform

/** Selects which of the two transforms the transform statements modify. */
enum ActiveTransform:
  case All, StartTime, EndTime

/** State saved by `AttributeBegin` and restored by `AttributeEnd`.
  *
  * @param transform current transform, from the coordinates of the next object to world space
  *   (before `WorldBegin` to camera space)
  * @param areaLight area light of the shapes that follow
  * @param defaults parameters of `Attribute`, by target ("shape", "light", …)
  */
final case class GraphicsState(
    transform: AnimatedTransform = GraphicsState.Identity,
    active: ActiveTransform = ActiveTransform.All,
    material: MaterialRef = MaterialRef.Default,
    areaLight: Option[Declaration] = None,
    reverseOrientation: Boolean = false,
    insideMedium: String = "",
    outsideMedium: String = "",
    scope: Scope = Scope.Empty,
    defaults: Map[String, Vector[Param]] = Map.empty,
    colorSpace: String = "srgb"
):

  /** A copy with `change` applied to the active transforms. */
  def transformed(change: Transform => Transform): GraphicsState =
    val AnimatedTransform(start, end) = transform
    copy(transform = active match
      case ActiveTransform.All if start eq end => GraphicsState.constant(change(start))
      case ActiveTransform.All => AnimatedTransform(change(start), change(end))
      case ActiveTransform.StartTime => AnimatedTransform(change(start), end)
      case ActiveTransform.EndTime => AnimatedTransform(start, change(end)))

  /** A copy with the transforms of `other`. */
  def withTransformsOf(other: GraphicsState): GraphicsState =
    copy(transform = other.transform, active = other.active)

object GraphicsState:
  val Identity: AnimatedTransform = constant(Transform.Identity)

  def constant(t: Transform): AnimatedTransform = AnimatedTransform(t, t)

  def inverse(t: AnimatedTransform): AnimatedTransform =
    if t.start eq t.end then constant(t.start.inverse)
    else AnimatedTransform(t.start.inverse, t.end.inverse)

/** An open block: its directive, its position, and the state to restore. */
final case class OpenBlock(begin: String, pos: SourcePos, saved: GraphicsState):
  def end: String = begin.replace("Begin", "End")

/** Maps the names of textures and materials at one point of a file to their unique names.
  *
  * v2 and v3 discard definitions at `AttributeEnd` and allow redefinition; earlier uses keep the
  * old meaning. A description has one list per kind, so redefinitions receive unique names here,
  * and later uses are renamed.
  */
final case class Scope(textures: Map[String, String], materials: Map[String, String]):

  /** The parameters, with texture and material names replaced by unique ones. */
  def resolve(params: Vector[Param]): Vector[Param] =
    if textures.isEmpty && materials.isEmpty then params else params.map(resolve)

  private def resolve(p: Param): Param =
    val names =
      if p.paramType == ParamType.Texture then textures
      else if Scope.MaterialParams.contains(p.name) then materials
      else Map.empty
    if !p.strings.exists(names.contains) then p
    else p.withStrings(p.strings.map(s => names.getOrElse(s, s)))

object Scope:
  val Empty: Scope = Scope(Map.empty, Map.empty)

  /** Parameters of "mix" that name materials. */
  private val MaterialParams = Set("namedmaterial1", "namedmaterial2", "materials")

/** Names in use, by kind. */
final class UniqueNames:
  private val reserved = mutable.HashMap.empty[String, mutable.HashSet[String]]

  private val counts = mutable.HashMap.empty[String, Int]

  /** Reserves the name; false if already in use. */
  def reserve(kind: String, name: String): Boolean =
    reserved.getOrElseUpdate(kind, mutable.HashSet.empty).add(name)

  def isTaken(kind: String, name: String): Boolean = reserved.get(kind).exists(_(name))

  /** A name like `name` that is unused in all the kinds. */
  def fresh(kinds: List[String], name: String): String =
    var unique = name
    while kinds.exists(isTaken(_, unique)) do
      val n = counts.getOrElse(name, 1) + 1
      counts(name) = n
      unique = s"$name ($n)"
    unique
