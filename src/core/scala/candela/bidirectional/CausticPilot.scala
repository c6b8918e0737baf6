package candela.bidirectional

import candela.base.{Parallel, loop}
import candela.color.Rgb
import candela.film.{Splats, View}
import candela.guiding.PhotonField
import candela.integrators.{CausticWeights, Integrator}
import candela.sampling.IndependentSampler
import candela.scene.{CasterLearning, Casters, Scene}

/** How light paths look for caustics.
  *
  * @param casters   where they begin, more often where caustics come from
  * @param perSample light paths per camera sample, on average
  * @param radius    within which photons are gathered at first, if paths leave them caustics
  * @param bringsAll do photons then bring all that media scatter to the camera?
  * @param aim       photons that guide the camera's paths, if they do
  */
final case class CausticChoice(
    casters: Casters,
    perSample: Float,
    radius: Float = 0f,
    bringsAll: Boolean = false,
    aim: Option[PhotonField] = None
)

/** Finds out by few paths whether light paths pay: whether they reduce the variance of the image by
  * more than they cost. Depends on the scene and its camera alone, not on the samples to be taken,
  * nor on threads: all parts of a rendering decide alike.
  *
  * Light that the camera's paths find once in a million samples is not seen by some thousand of
  * them. But a light path that finds it knows the densities of both, and so the second moment that
  * it has in either: with f the light of a path, p its density for the camera and q that for light
  * paths, the integral of f²/p is the mean of (f/q)² · q/p over light paths.
  *
  * Most of a variance may come from paths that are seldom found. A few paths miss them, and what
  * light paths leave to the camera's seems less than it is. So what seems to pay is looked at again
  * with [[Rounds]] times as many paths.
  *
  * @param pool   for paths that are traced at once; what is found is the same for any
  * @param tracer paths from the camera, weighted against light paths
  */
private[candela] final class CausticPilot(
    scene: Scene,
    view: View,
    light: CausticLight,
    pool: Parallel,
    tracer: CausticWeights => Integrator
):
  import CausticPilot.*

  /** @return the choice, if light paths pay; and why, or why not */
  def run(): (Option[CausticChoice], String) =
    if !light.isCameraWhereItSays(scene, view) then (None, CausticPilot.CameraElsewhere)
    else
      val learnt = traced(light, 0, LearningPaths, Seed, isLearning = true)
      if learnt.splats == 0 then withoutSplats else look(light.casters.aimed(learnt.learning.aim))

  private def withoutSplats: (Option[CausticChoice], String) =
    val why = "no light path reaches the camera"
    // Manifold walks may find the light yet
    if !light.findsAll || light.media.isDefined || !scene.lights.exists(_.isDelta) then
      (None, s"none: $why")
    else
      (
        Some(CausticChoice(light.casters, Least.toFloat)),
        s"$why: manifold walks alone look for the light"
      )

  private def look(aimed: Casters): (Option[CausticChoice], String) =
    val found = looked(aimed, 0, 1)
    val first = Expected.of(found)
    val expected =
      if light.findsAll || !first.pays then first
      else
        found.add(looked(aimed, 1, Rounds))
        Expected.of(found)
    if light.findsAll || expected.pays then
      (Some(CausticChoice(aimed, expected.perSample.toFloat)), expected.toString)
    else (None, s"none: $expected")

  /** What light paths and the camera's paths of some rounds find. */
  private def looked(aimed: Casters, from: Int, until: Int): Found =
    val by = light.copy(casters = aimed)
    val found =
      traced(by, from * LookingPaths, until * LookingPaths, Seed + 1, isLearning = false)
    val weights = CausticWeights(scene, aimed, view.camera, 1f)
    found.blocks.add:
      CameraPairs.followed(view, Seed + 2, pool, from * Pairs, until * Pairs): _ =>
        (tracer(weights), (_, _) => ())
    found

  /** What the light paths `from` to `until` find. */
  private def traced(
      by: CausticLight,
      from: Int,
      until: Int,
      seed: Int,
      isLearning: Boolean
  ): Found =
    val each = LightPathsOfPart
    val found = Found()
    pool
      .map((until - from) / each): i =>
        val part = Found()
        part.trace(by, from + i * each, from + (i + 1) * each, seed, isLearning)
        part
      .foreach(found.add)
    found

  /** What some of the paths found. Mutable. */
  private final class Found:
    val blocks = PilotBlocks(view)
    val learning = CasterLearning()
    var splats, lightRays = 0L
    var lightPaths = 0

    def add(other: Found): Unit =
      blocks.add(other.blocks)
      learning.addAll(other.learning)
      splats += other.splats
      lightRays += other.lightRays
      lightPaths += other.lightPaths

    def trace(by: CausticLight, from: Int, until: Int, seed: Int, isLearning: Boolean): Unit =
      val within = by.within(scene)
      val paths = by.paths(scene, within)
      val observer = Observer(paths, this, isLearning)
      val camera = CameraConnection(scene, view.camera, Splats.Discarded, within, 1f, observer)
      val sampler = IndependentSampler(1, seed)
      loop(from, until): k =>
        CameraPairs.start(view, sampler, k)
        val time = view.shutter.fold(0f)(_.at(sampler.next1D()))
        camera.begin(time)
        paths.trace(time, sampler)
        camera.connect(paths, isWeighted = true, sampler)
      val inMedia = if within == null then 0L else within.raysTraced
      lightRays = paths.raysTraced + camera.raysTraced + inMedia
      lightPaths = until - from

  /** Adds what light paths find. */
  private final class Observer(paths: CausticPaths, found: Found, isLearning: Boolean)
      extends SplatObserver:
    def see(x: Float, y: Float, light: Rgb, others: Double): Unit =
      val weighted = light.average.toDouble
      if weighted > 0.0 && weighted < Float.PositiveInfinity && found.blocks.contains(x, y) then
        found.splats += 1
        if isLearning then found.learning.add(paths.place, weighted)
        else
          // The weight is 1 / (1 + others); q/p of the light path
          val ratio =
            Math.min(if others > 0.0 then 1.0 / Math.sqrt(others) else MostRatio, MostRatio)
          val whole = weighted * (1.0 + others)
          val rest = whole - weighted
          found.blocks
            .addSplat(
              x,
              y,
              weighted,
              whole * whole * ratio,
              rest * rest * ratio,
              weighted * weighted
            )

  /** What is expected of light paths.
    *
    * @param gain      factor of efficiency
    * @param perSample light paths per camera sample, for the greatest
    */
  private final class Expected(gain: Double, val perSample: Double):
    def pays: Boolean = gain > LeastGain

    override def toString: String =
      f"the pilot expects ${times(gain)} times the efficiency, with $perSample%.3g light " +
        "paths per camera sample"

  private object Expected:
    def of(found: Found): Expected =
      val cost = (found.lightRays.toDouble / found.lightPaths) / found.blocks.raysPerPath
      val (byPaths, more, byLight) = found.blocks.variances(found.lightPaths)
      val best = Math.sqrt(byLight / (byPaths * cost))
      val perSample = Math.max(Least, Math.min(Math.scalb(1.0, Math.getExponent(best)), Most))
      val after = (byPaths + byLight / perSample) * (1 + perSample * cost)
      Expected(gainOf(byPaths + more, after), perSample)

private[candela] object CausticPilot:
  inline val LearningPaths = 16384
  inline val LookingPaths = 16384
  inline val Pairs = 2048

  /** Light paths that are traced by one thread. */
  inline val LightPathsOfPart = 1024

  /** Times as many paths, before light paths are taken. */
  inline val Rounds = 4
  inline val Seed = 0x5eed

  /** What is said if [[CausticLight.isCameraWhereItSays]] doesn't hold. */
  val CameraElsewhere: String =
    "none: the first border of media before the camera says that it is in another medium"

  /** Light paths per camera sample. */
  inline val Least = 0.125
  inline val Most = 2.0

  /** What one light path finds must not decide alone. */
  inline val MostRatio = 1e6

  /** Expected efficiency from which on light paths are taken. The pilot is not exact: what paths
    * would have found once in a billion samples counts for it, too, and fireflies that no light
    * path finds may be missed.
    */
  inline val LeastGain = 3.0

  /** The factor of efficiency, from variance times cost before and after; one where nothing is
    * noisy.
    */
  def gainOf(before: Double, after: Double): Double = if after > 0.0 then before / after else 1.0

  def times(gain: Double): String = if gain > 10.0 then "more than 10" else f"$gain%.2f"
