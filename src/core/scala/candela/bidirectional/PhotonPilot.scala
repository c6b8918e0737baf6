package candela.bidirectional

import candela.base.Parallel
import candela.film.View
import candela.scene.Scene

/** Finds out which photons arrive where the camera sees them, and how large a pixel is there.
  * Depends on the scene and its camera alone, as [[CausticPilot]].
  */
private[candela] final class PhotonPilot(
    scene: Scene,
    view: View,
    light: CausticLight,
    pool: Parallel
):
  import PhotonPilot.*

  /** @return the choice, if there are such photons; and what is done, or why nothing is */
  def run(): (Option[CausticChoice], String) =
    if light.isCameraWhereItSays(scene, view) then look()
    else (None, CausticPilot.CameraElsewhere)

  private def look(): (Option[CausticChoice], String) =
    val places = SeenPlaces(scene, view, light, pool, CameraPaths, onlyBehind = false)
    if places.isEmpty then (None, s"none: the camera sees no $receivers that receives photons")
    else
      val learning = places.learn()
      if learning.isEmpty then (None, "none: no photons arrive where the camera sees them")
      else
        val radius = Pixels * places.footprint
        val aimed = light.casters.aimed(learning.aim)
        val all = mayBringAll && places.othersOfPath() > LeastOthers
        val told =
          f"photon maps bring ${brought(all)}, with a radius of $radius%.3g in the first pass, " +
            "and less in each that follows; the image is biased"
        (Some(CausticChoice(aimed, 1f, radius = radius, bringsAll = all)), told)

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
  inline val LeastOthers = 0.5
