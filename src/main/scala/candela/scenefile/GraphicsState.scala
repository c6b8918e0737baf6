package candela.scenefile

import scala.collection.mutable

import candela.base.SourcePos
import candela.math.Transform

/** Which of the two transforms the transform statements change. */
enum ActiveTransform:
  case All, StartTime, EndTime

/** What `AttributeBegin` saves and `AttributeEnd` brings back.
  *
  * @param transform  the current transform: from the coordinates of what comes next to world space
  *                   (to camera space before `WorldBegin`)
  * @param areaLight  what shapes emit
  * @param defaults   parameters of `Attribute` by target ("shape", "light", …)
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

  /** With the active transforms replaced by what `change` makes of them. */
  def transformed(change: Transform => Transform): GraphicsState =
    val AnimatedTransform(start, end) = transform
    copy(transform = active match
      case ActiveTransform.All if start eq end => GraphicsState.still(change(start))
      case ActiveTransform.All => AnimatedTransform(change(start), change(end))
      case ActiveTransform.StartTime => AnimatedTransform(change(start), end)
      case ActiveTransform.EndTime => AnimatedTransform(start, change(end)))

  /** With the transforms of `other`, and all else as it is. */
  def withTransformsOf(other: GraphicsState): GraphicsState =
    copy(transform = other.transform, active = other.active)

object GraphicsState:
  val Identity: AnimatedTransform = still(Transform.Identity)

  def still(t: Transform): AnimatedTransform = AnimatedTransform(t, t)

  def inverse(t: AnimatedTransform): AnimatedTransform =
    if t.start eq t.end then still(t.start.inverse)
    else AnimatedTransform(t.start.inverse, t.end.inverse)

/** A block that is open: the directive that opened it, where, and what its end brings back. */
final case class OpenBlock(begin: String, at: SourcePos, saved: GraphicsState):
  def end: String = begin.replace("Begin", "End")

/** What names of textures and materials mean at one place of a file, where that is not themselves.
  *
  * v2 and v3 forget definitions at `AttributeEnd` and let a name be defined again; what used it
  * before keeps the old meaning. A description has one list of each kind, so later definitions get
  * unique names of their own here, and later uses follow.
  */
final case class Scope(textures: Map[String, String], materials: Map[String, String]):

  /** A declaration whose parameters name textures and materials by their unique names. */
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

  /** The parameters of "mix" that name materials. */
  private val MaterialParams = Set("namedmaterial1", "namedmaterial2", "materials")

/** Names that were given out already, by kind. */
final class UniqueNames:
  private val taken = mutable.HashMap.empty[String, mutable.HashSet[String]]

  private val counts = mutable.HashMap.empty[String, Int]

  /** Takes the name; false if it is taken already. */
  def take(kind: String, name: String): Boolean =
    taken.getOrElseUpdate(kind, mutable.HashSet.empty).add(name)

  def isTaken(kind: String, name: String): Boolean = taken.get(kind).exists(_(name))

  /** A name like `name` that is taken in none of the kinds. */
  def fresh(kinds: List[String], name: String): String =
    var unique = name
    while kinds.exists(isTaken(_, unique)) do
      val n = counts.getOrElse(name, 1) + 1
      counts(name) = n
      unique = s"$name ($n)"
    unique
