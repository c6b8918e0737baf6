package candela.bidirectional

import candela.base.Parallel
import candela.film.View
import candela.guiding.{Guide, PhotonField}
import candela.integrators.Integrator
import candela.scene.Scene

/** Finds out by few paths whether it pays that photons guide the camera's paths. Depends on the
  * scene and its camera alone, as [[CausticPilot]].
  *
  * What a guided path finds, it finds with a known density, and so is that of an unguided one
  * known: the mean of (f/q)² · q/p over guided paths is the second moment that f has in unguided
  * ones, however seldom these find it.
  *
  * @param tracer the camera's paths, guided by photons, as [[Guide.unlearning]] says, or not
  */
private[candela] final class AimPilot(
    scene: Scene,
    view: View,
    light: CausticLight,
    pool: Parallel,
    tracer: (Option[PhotonField], Guide) => Integrator
):
  import AimPilot.*
  private val photons = AimingPhotons(scene, view, light, pool)

  /** @return the photons, if they pay; and what is expected of them, or why there are none */
  def run(): (Option[PhotonField], String) =
    photons.trace(FewPaths) match
      case None => (None, "no photons arrive where only specular surfaces show them to the camera")
      case Some(few) =>
        val gain = expected(few)
        val figures = s"the pilot expects ${CausticPilot.times(gain)} times the efficiency"
        if gain > CausticPilot.LeastGain then
          val paths = Math.min(view.pixels * PerPixel, MostPaths).toInt
          (photons.trace(Math.max(paths, FewPaths)), figures)
        else (None, s"photons don't pay: $figures")

  private def expected(field: PhotonField): Double =
    val plain = followed(None, 0, RayPairs)
    val found = followed(Some(field), 0, CausticPilot.Pairs)
    def gain: Double =
      val (aimed, saved) = found.savings()
      val cost = Overhead * found.raysPerPath / plain.raysPerPath
      CausticPilot.gainOf(aimed + saved, aimed * cost)
    if gain > CausticPilot.LeastGain then
      found.add(
        followed(Some(field), CausticPilot.Pairs, CausticPilot.Rounds * CausticPilot.Pairs)
      )
    gain

  /** Follows the pairs `from` to `until`. */
  private def followed(field: Option[PhotonField], from: Int, until: Int): PilotBlocks =
    CameraPairs.followed(view, Seed, pool, from, until): part =>
      val guide = Guide.unlearning
      (tracer(field, guide), (x, y) => part.addSaving(x, y, guide.takeSaving()))

private[candela] object AimPilot:
  /** Light paths of the pilot. */
  inline val FewPaths = 1 << 15

  /** Light paths for a pixel, and at most, where it finds them useful. */
  inline val PerPixel = 16
  inline val MostPaths = 1 << 18

  /** Pairs of paths that tell how many rays an unguided path has. */
  inline val RayPairs = 512
  inline val Seed = 0xa1f

  /** Time of guided paths, relative to unguided ones of as many rays. */
  inline val Overhead = 1.15
