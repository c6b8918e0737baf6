package candela.build

import candela.diagnostics.Problem
import candela.math.Position
import candela.render.RenderPlan
import candela.scenefile.SceneDescription
import candela.settings.RenderSettings

/** A scene whose world is built, as its camera sees it, and others can.
  *
  * @param warnings of the build
  * @param origin   the point of the scene's world that is the origin of what is built
  */
final class BuiltScene private[build] (
    val plan: RenderPlan,
    val warnings: Vector[Problem],
    val origin: Position
)(planned: (SceneDescription, RenderSettings) => Option[RenderPlan]):

  /** The plan for another camera of the scene, the same as if it were built for it.
    *
    * @param seen     the scene, but for the camera's statement and place
    * @param settings those of the build, but for resolution, region and samples
    * @return none if the world must be built for it: it is built around a point near the camera
    * @throws candela.diagnostics.SceneError if the camera has errors
    */
  def seenAs(seen: SceneDescription, settings: RenderSettings): Option[RenderPlan] =
    planned(seen, settings)
