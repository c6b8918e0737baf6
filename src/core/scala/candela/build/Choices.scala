package candela.build

import candela.build.sampling.PointChoice
import candela.guiding.GuidingMode
import candela.integrators.CausticsMode

/** What trades noise for time. What the user asks for counts; else, with a goal, what was measured
  * to reach it best, and with a number of samples what the scene says.
  *
  * @param byGoal whether paths are guided because of the goal
  */
final case class Choices(
    points: PointChoice,
    guiding: GuidingMode,
    caustics: CausticsMode,
    byGoal: Boolean = false
):
  private[build] def in(s: RenderSettings): RenderSettings =
    s.copy(points = Some(points), guiding = Some(guiding), caustics = Some(caustics))

object Choices:
  /** What the scene says. */
  val OfScene: Choices = Choices(PointChoice.Best, GuidingMode.Off, CausticsMode.Off)

  /** The best for a goal: docs/SAMPLERS.md, docs/decisions/0020-path-guiding.md,
    * docs/CAUSTICS.md.
    */
  private val ForGoal =
    Choices(PointChoice.Progressive, GuidingMode.Progressive, CausticsMode.Auto)

  /** Seconds of rendering that are worth the pilots of caustics, which take up to one. */
  private inline val WorthPilots = 20.0

  private[build] val Why =
    "chosen as a time or an error ends the rendering (--guiding off takes none)"

  private[build] val NoCaustics =
    "found by the camera's paths alone, as the time is short (--caustics auto looks for them)"

  private[build] def of(s: RenderSettings): Choices =
    val isByGoal = s.goal.isGiven && !s.preview
    val usual = if isByGoal then ForGoal else OfScene
    val caustics =
      if s.goal.time.exists(_ < WorthPilots) then CausticsMode.Off else usual.caustics
    val guiding = s.guiding match
      case Some(GuidingMode.Auto) if s.isEndless => GuidingMode.Progressive
      case asked => asked.getOrElse(usual.guiding)
    Choices(
      s.points.getOrElse(usual.points),
      guiding,
      s.caustics.getOrElse(caustics),
      isByGoal && s.guiding.isEmpty
    )
