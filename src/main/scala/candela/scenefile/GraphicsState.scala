package candela.scenefile

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
