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
    val places = SeenPlaces(scene, view, light, pool, Looks, onlyBehind = false)
    if places.isEmpty then (None, "none: the camera sees no surface that receives photons")
    else
      val learning = places.learn()
      if learning.isEmpty then (None, "none: no photons arrive where the camera sees them")
      else
        val radius = Pixels * places.footprint
        val aimed = light.casters.aimed(learning.aim)
        val told =
          f"photons of light that casters scatter, gathered within a radius of $radius%.3g " +
            "in the first pass, and less in each that follows; the image is biased"
        (Some(CausticChoice(aimed, 1f, radius)), told)

private[candela] object PhotonPilot:
  /** Paths of the camera. */
  inline val Looks = 4096

  /** The first radius, in pixels: each gathers some ten photons where they are evenly spread. */
  inline val Pixels = 2f
