package candela.caustics

import candela.film.View
import candela.integrators.CausticWeights
import candela.scene.{Casters, Scene}

import java.util.Locale

/** How caustics are found beside the camera's paths. */
sealed trait CausticChoice

/** How light paths look for caustics.
  *
  * @param casters   where they begin, more often where caustics come from
  * @param perSample light paths per camera sample, on average
  */
final case class LightPathChoice(casters: Casters, perSample: Float) extends CausticChoice:
  override def toString: String =
    "%.3g light paths per camera sample".formatLocal(Locale.ROOT, perSample)

  private[candela] def weights(scene: Scene, view: View): CausticWeights =
    CausticWeights(scene, casters, view.camera, perSample)

/** How photons bring caustics.
  *
  * @param casters   where light paths begin, more often where caustics come from
  * @param radius    within which photons are gathered at first
  * @param bringsAll do photons then bring all that media scatter to the camera?
  * @param brings    what they bring, in words
  */
final case class PhotonChoice(
    casters: Casters,
    radius: Float,
    bringsAll: Boolean,
    brings: String
) extends CausticChoice:
  override def toString: String =
    val first = "%.3g".formatLocal(Locale.ROOT, radius)
    s"photon maps, which bring $brings, with a radius of $first in the first pass, " +
      "and less in each that follows; the image is biased"
