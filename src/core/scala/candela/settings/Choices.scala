package candela.settings

import candela.guiding.GuidingMode
import candela.integrators.CausticsMode

/** What trades noise for time. The user's choice, if there is one. Otherwise, with a goal: what
  * reached goals soonest in measurements; with a number of samples: what the scene says.
  *
  * @param byGoal whether paths are guided because of the goal
  */
final case class Choices(
    points: PointChoice,
    guiding: GuidingMode,
    caustics: CausticsMode,
    byGoal: Boolean = false
):
  private[settings] def applyTo(s: RenderSettings): RenderSettings =
    s.copy(points = Some(points), guiding = Some(guiding), caustics = Some(caustics))

object Choices:
  /** What the scene says. */
  val OfScene: Choices = Choices(PointChoice.Best, GuidingMode.Off, CausticsMode.Off)

  /** The best for a goal: docs/SAMPLERS.md, docs/decisions/0020-path-guiding.md,
    * docs/CAUSTICS.md.
    */
  private val ForGoal =
    Choices(PointChoice.Progressive, GuidingMode.Auto, CausticsMode.Auto)

  /** Why paths are guided, in messages. */
  val Why =
    "chosen as a time or an error ends the rendering (--guiding off takes none)"

  private[settings] def of(s: RenderSettings): Choices =
    val isByGoal = s.goal.isGiven && !s.preview
    val defaults = if isByGoal then ForGoal else OfScene
    Choices(
      s.points.getOrElse(defaults.points),
      s.guiding.getOrElse(defaults.guiding),
      s.caustics.getOrElse(defaults.caustics),
      isByGoal && s.guiding.isEmpty
    )
