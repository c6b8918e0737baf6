package candela.caustics

import candela.concurrency.Parallel
import candela.film.View
import candela.integrators.{Integrator, PhotonLight}
import candela.scene.Scene

/** Finds out which photons arrive where the camera sees them, and how large a pixel is there; and
  * whether they pay, if that is asked. Depends on the scene and its camera alone, as
  * [[CausticPilot]].
  *
  * @param trial the camera's paths, without photons or with them, if photons are only taken where
  *              they pay
  */
private[candela] final class PhotonPilot(
    scene: Scene,
    view: View,
    light: CausticLight,
    pool: Parallel,
    trial: Option[Option[PhotonLight] => Integrator]
):
  import PhotonPilot.*

  def run(): PilotResult =
    if light.isCameraWhereItSays(scene, view) then evaluate()
    else PilotResult.none(CausticPilot.CameraElsewhere)

  private def evaluate(): PilotResult =
    val visible = SeenPlaces(scene, view, light, pool, CameraPaths)
    if visible.isEmpty then PilotResult.none(s"the camera sees no $receivers that receives photons")
    else
      val learning = visible.learn()
      if learning.isEmpty then PilotResult.none("no photons arrive where the camera sees them")
      else
        val bringsAll = mayBringAll && visible.othersOfPath() > MinOthersOfPath
        val radius = Pixels * visible.footprint
        val choice =
          PhotonChoice(light.casters.aimed(learning.aim), radius, bringsAll, brought(bringsAll))
        trial match
          case None => PilotResult(Some(choice), 0.0, pays = true, choice.toString)
          case Some(paths) => PhotonTrial(scene, view, light, choice, pool, paths).run()

  /** May photons bring all that media scatter? They can't begin at skies behind portals. */
  private def mayBringAll: Boolean =
    light.suitsPhotons && light.beginsAtEmitters(scene) &&
      scene.environments.forall(_.power(scene.ball) > 0f)

  private def receivers = if light.media.isDefined then "surface or medium" else "surface"

  private def brought(all: Boolean) =
    if all then "caustics, and all light that media scatter"
    else if light.media.isDefined then "caustics at surfaces and in media"
    else "caustics"

private[candela] object PhotonPilot:
  inline val CameraPaths = 4096

  /** The first radius, in pixels: each gathers some ten photons where they are evenly spread. */
  inline val Pixels = 2f

  /** Photons that a light path leaves in media where the camera looks, from which on they bring all
    * that media scatter: then a ray passes a few in each pass.
    */
  inline val MinOthersOfPath = 0.5
