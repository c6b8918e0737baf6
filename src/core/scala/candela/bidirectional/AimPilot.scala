package candela.bidirectional

import candela.base.{Parallel, loop}
import candela.film.View
import candela.guiding.{Guide, PhotonField}
import candela.integrators.{Integrator, Manifolds, WalkTally}
import candela.scene.Scene

/** How paths from the camera find light that comes to it by way of specular surfaces on both sides
  * of another: photons guide them, or say where manifold walks begin.
  *
  * @param photons that arrive there
  * @param walked  what walks look for; None: photons guide paths
  */
final case class SeenLight(photons: PhotonField, walked: Option[SeenLight.Walked]):

  /** Photons that guide paths. */
  private[candela] def guiding: Option[PhotonField] = Option.when(walked.isEmpty)(photons)

  /** Photons that walks begin by. */
  private[candela] def seeding: Option[PhotonField] = Option.when(walked.isDefined)(photons)

  /** Time of such paths, relative to others of as many rays. */
  private[bidirectional] def overhead: Double =
    if walked.isEmpty then AimPilot.GuidedOverhead else AimPilot.WalkedOverhead

object SeenLight:
  /** @param emitters that walks look for
    * @param usual light of a chain, as in [[Manifolds]]
    */
  final case class Walked(emitters: Set[Int], usual: Float)

/** Finds out by few paths whether it pays that photons guide the camera's paths, or that manifold
  * walks begin where photons came from. Depends on the scene and its camera alone, as
  * [[CausticPilot]].
  *
  * What a guided path finds, it finds with a known density, and so is that of an unguided one
  * known: the mean of (f/q)² · q/p over guided paths is the second moment that f has in unguided
  * ones, however seldom these find it. The same holds for walks.
  *
  * @param tracer the camera's paths: guided by photons, as [[Guide.unlearning]] says, or not
  * @param walker paths that look for light by such walks
  */
private[candela] final class AimPilot(
    scene: Scene,
    view: View,
    light: CausticLight,
    pool: Parallel,
    tracer: (Option[PhotonField], Guide) => Integrator,
    walker: Manifolds => Integrator
):
  import AimPilot.*
  private val photons = AimingPhotons(scene, view, light, pool)

  /** @return what is done, if it pays; and what is expected of it, or why it isn't done */
  def run(): (Option[SeenLight], String) =
    photons.trace(FewPaths) match
      case None => (None, "no photons arrive where only specular surfaces show them to the camera")
      case Some(few) =>
        val plain = followed(None, 0, RayPairs).raysPerPath
        val guided = ofGuided(few, plain)
        val (walks, walked) =
          if light.media.isDefined || !scene.isSolid then (None, 1.0) else ofWalks(few, plain)
        val byWalks = walked > CausticPilot.LeastGain &&
          (guided <= CausticPilot.LeastGain || walked > LeastGainOfWalks * guided)
        val gain = if byWalks then walked else guided
        val figures = s"the pilot expects ${CausticPilot.times(gain)} times the efficiency"
        if gain > CausticPilot.LeastGain then
          val paths = Math.min(view.pixels * PerPixel, MostPaths).toInt
          val field = photons.trace(Math.max(paths, FewPaths))
          (field.map(SeenLight(_, walks.filter(_ => byWalks))), figures)
        else (None, s"photons and walks from them don't pay: $figures")

  /** @param plain rays of a path otherwise */
  private def ofGuided(field: PhotonField, plain: Double): Double =
    val found = followed(Some(field), 0, CausticPilot.Pairs)
    def gain: Double = gainOf(found, plain, GuidedOverhead)
    if gain > CausticPilot.LeastGain then
      found.add(
        followed(Some(field), CausticPilot.Pairs, CausticPilot.Rounds * CausticPilot.Pairs)
      )
    gain

  /** What walks look for, and the factor of efficiency. */
  private def ofWalks(
      field: PhotonField,
      plain: Double
  ): (Option[SeenLight.Walked], Double) =
    val all = (i: Int) => !scene.lights(i).isDelta
    val (_, first) = walked(field, all, 0f, 0, FirstPairs)
    val saved = new Array[Double](scene.lights.length)
    for tally <- first do loop(saved.length)(i => saved(i) += tally.saved(i))
    val emitters = saved.indices.filter(saved(_) > 0.0).toSet
    if emitters.isEmpty then (None, 1.0)
    else
      val usual = (first.map(_.light).sum / first.map(_.count).sum).toFloat
      def of(from: Int, until: Int) = walked(field, emitters, usual, from, until)._1
      def gain(found: PilotBlocks) = gainOf(found, plain, WalkedOverhead)
      val found = of(FirstPairs, CausticPilot.Pairs)
      if gain(found) > CausticPilot.LeastGain then
        found.add(of(CausticPilot.Pairs, 2 * CausticPilot.Pairs))
      (Some(SeenLight.Walked(emitters, usual)), gain(found))

  private def gainOf(found: PilotBlocks, plain: Double, overhead: Double): Double =
    val (variance, saved) = found.savings()
    CausticPilot.gainOf(variance + saved, variance * overhead * found.raysPerPath / plain)

  /** Follows the pairs `from` to `until`. */
  private def followed(field: Option[PhotonField], from: Int, until: Int): PilotBlocks =
    CameraPairs.followed(view, Seed, pool, from, until): part =>
      val guide = Guide.unlearning
      (tracer(field, guide), (x, y) => part.addSaving(x, y, guide.takeSaving()))

  /** Follows the pairs `from` to `until`, with walks to these emitters. */
  private def walked(
      field: PhotonField,
      emitters: Int => Boolean,
      usual: Float,
      from: Int,
      until: Int
  ): (PilotBlocks, Vector[WalkTally]) =
    CameraPairs.counted(view, Seed, pool, from, until): part =>
      val tally = WalkTally(scene.lights.length)
      val walks = Manifolds(scene, light.maxDepth, emitters, field, MostWalks, usual, tally)
      (walker(walks), (x, y) => part.addSaving(x, y, tally.take()), tally)

private[candela] object AimPilot:
  /** Light paths of the pilot. */
  inline val FewPaths = 1 << 15

  /** Light paths for a pixel, and at most, where it finds them useful. */
  inline val PerPixel = 16
  inline val MostPaths = 1 << 18

  /** Pairs of paths that tell how many rays an unguided path has. */
  inline val RayPairs = 512

  /** Pairs that tell which emitters walks shall look for. */
  inline val FirstPairs = 512

  /** Walks for the probability of a chain, in the pilot. */
  inline val MostWalks = 20000
  inline val Seed = 0xa1f

  /** Time of guided paths, relative to unguided ones of as many rays; and of walks. */
  inline val GuidedOverhead = 1.15
  inline val WalkedOverhead = 1.5

  /** By how much walks must be better than guided paths, which find chains of any length. */
  inline val LeastGainOfWalks = 2.0
