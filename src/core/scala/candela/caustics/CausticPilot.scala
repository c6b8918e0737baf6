package candela.caustics

import candela.base.loop
import candela.bdpt.{CameraConnection, SplatObserver}
import candela.concurrency.Parallel
import candela.color.Rgb
import candela.film.{Splats, View}
import candela.integrators.{CausticWeights, Integrator}
import candela.sampling.IndependentSampler
import candela.scene.{CasterLearning, Casters, Scene}

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

  def run(): PilotResult =
    if !light.isCameraWhereItSays(scene, view) then PilotResult.none(CausticPilot.CameraElsewhere)
    else
      val learnt = traced(light, 0, LearningPaths, Seed, isLearning = true)
      if learnt.splats == 0 then PilotResult.none("no light path reaches the camera")
      else look(light.casters.aimed(learnt.learning.aim))

  private def look(aimed: Casters): PilotResult =
    val found = look(aimed, 0, 1)
    val first = expected(found, aimed)
    if light.findsAll || !first.pays then first
    else
      found.add(look(aimed, 1, Rounds))
      expected(found, aimed)

  /** What light paths and the camera's paths of some rounds find. */
  private def look(aimed: Casters, from: Int, until: Int): Found =
    val by = light.copy(casters = aimed)
    val found =
      traced(by, from * LookingPaths, until * LookingPaths, Seed + 1, isLearning = false)
    val weights = CausticWeights(scene, aimed, view.camera, 1f)
    found.pairs.add(CameraPairs.followed(view, Seed + 2, pool, from * Pairs, until * Pairs): () =>
      val paths = tracer(weights)
      (paths, paths))
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
    /** Of light paths, and of the camera's paths beside them. */
    val splatted, pairs = PilotBlocks(view)
    val learning = CasterLearning()
    var splats = 0L

    var lightRays = 0L
    var lightPaths = 0

    def add(other: Found): Unit =
      pairs.add(other.pairs)
      splatted.add(other.splatted)
      learning.addAll(other.learning)
      splats += other.splats
      lightRays += other.lightRays
      lightPaths += other.lightPaths

    def variances: PilotBlocks.Variances =
      val all = PilotBlocks(view)
      all.add(splatted)
      all.add(pairs)
      all.variances(lightPaths, usual)

    def trace(by: CausticLight, from: Int, until: Int, seed: Int, isLearning: Boolean): Unit =
      val within = by.within(scene)
      val paths = by.paths(scene, within)
      val observer = Observer(this, if isLearning then Some(paths) else None)
      val camera = CameraConnection(scene, view.camera, Splats.Discarded, within, observer)
      val sampler = IndependentSampler(1, seed)
      loop(from, until): k =>
        CameraPairs.start(view, sampler, k)
        val time = view.shutter.fold(0f)(_.at(sampler.next1D()))
        camera.begin(time)
        paths.trace(time, sampler)
        camera.connect(paths, isWeighted = true, sampler)
      val inMedia = if within == null then 0L else within.raysTraced
      lightRays += paths.raysTraced + camera.raysTraced + inMedia
      lightPaths += until - from

  /** Adds what light paths find.
    *
    * @param learns from these paths where they begin, if at all
    */
  private final class Observer(found: Found, learns: Option[CausticPaths]) extends SplatObserver:
    def see(x: Float, y: Float, light: Rgb, others: Double): Unit =
      val weighted = light.average.toDouble
      if weighted > 0.0 && weighted < Float.PositiveInfinity && found.splatted.contains(x, y) then
        found.splats += 1
        if learns.isDefined then for p <- learns do found.learning.add(p.place, weighted)
        else
          // The weight is 1 / (1 + others); q/p of the light path
          val ratio =
            Math.min(if others > 0.0 then 1.0 / Math.sqrt(others) else MostRatio, MostRatio)
          found.splatted.addSplat(x, y, weighted, weighted * (1.0 + others), ratio)

  /** Samples of an image for which light paths shall pay. In media they seem to bring more than
    * they can, by light that is found once in a million samples. Elsewhere that light is most of
    * the gain where they pay, too.
    */
  private val usual =
    if light.media.isDefined then PilotBlocks.UsualSamples else PilotBlocks.EndlessSamples

  private def expected(found: Found, aimed: Casters): PilotResult =
    val cost = found.lightRays.toDouble / Math.max(1, found.lightPaths) / found.pairs.raysPerPath
    val variances = found.variances
    import variances.*
    // Rounded down, as the ring of docs/CAUSTICS.md asks
    val perSample = amount(Math.sqrt(byLight / (byPaths * cost)))
    val left = (byPaths + byLight / perSample) * (1.0 + cost * perSample)
    val choice = LightPathChoice(aimed, perSample.toFloat)
    PilotResult.of(choice, without = byPaths + without, left, mustPay = !light.findsAll)

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
    "the first border of media before the camera says that it is in another medium"

  /** Bounds of the light paths per camera sample. */
  inline val MinPathsPerSample = 1.0 / 64
  inline val MaxPathsPerSample = 16.0

  /** What one light path finds must not decide alone. */
  inline val MostRatio = 1e6

  /** A power of two, not above `best`, within bounds.
    *
    * @param best not a number where neither light paths nor the camera's find anything
    */
  def amount(best: Double): Double =
    if best > 0.0 then
      val power = Math.scalb(1.0, Math.getExponent(best))
      Math.max(MinPathsPerSample, Math.min(power, MaxPathsPerSample))
    else MinPathsPerSample
