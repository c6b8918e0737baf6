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
      else evaluate(light.casters.aimed(learnt.learning.aim))

  private def evaluate(aimed: Casters): PilotResult =
    val findings = probe(aimed, 0, 1)
    val first = expected(findings, aimed)
    if light.findsAll || !first.pays then first
    else
      findings.add(probe(aimed, 1, Rounds))
      expected(findings, aimed)

  /** What light paths and the camera's paths of some rounds find. */
  private def probe(aimed: Casters, from: Int, until: Int): Found =
    val aimedLight = light.copy(casters = aimed)
    val findings =
      traced(aimedLight, from * LookingPaths, until * LookingPaths, Seed + 1, isLearning = false)
    val weights = CausticWeights(scene, aimed, view.camera, 1f)
    findings.pairs.add(CameraPairs.followed(view, Seed + 2, pool, from * Pairs, until * Pairs):
      () =>
        val paths = tracer(weights)
        (paths, paths))
    findings

  /** What the light paths `from` to `until` find. */
  private def traced(
      by: CausticLight,
      from: Int,
      until: Int,
      seed: Int,
      isLearning: Boolean
  ): Found =
    val batchSize = LightPathsOfPart
    val findings = Found()
    pool
      .map((until - from) / batchSize): i =>
        val partial = Found()
        partial.trace(by, from + i * batchSize, from + (i + 1) * batchSize, seed, isLearning)
        partial
      .foreach(findings.add)
    findings

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
      val blocks = PilotBlocks(view)
      blocks.add(splatted)
      blocks.add(pairs)
      blocks.variances(lightPaths, imageSamples)

    def trace(by: CausticLight, from: Int, until: Int, seed: Int, isLearning: Boolean): Unit =
      val pathMedia = by.pathMedia(scene)
      val paths = by.paths(scene, pathMedia)
      val observer = Observer(this, if isLearning then Some(paths) else None)
      val camera = CameraConnection(scene, view.camera, Splats.Discarded, pathMedia, observer)
      val sampler = IndependentSampler(1, seed)
      loop(from, until): k =>
        CameraPairs.start(view, sampler, k)
        val time = view.shutter.fold(0f)(_.at(sampler.next1D()))
        camera.startSample(time)
        paths.trace(time, sampler)
        camera.connect(paths, isWeighted = true, sampler)
      val inMedia = if pathMedia == null then 0L else pathMedia.raysTraced
      lightRays += paths.raysTraced + camera.raysTraced + inMedia
      lightPaths += until - from

  /** Adds what light paths find.
    *
    * @param learns from these paths where they begin, if at all
    */
  private final class Observer(findings: Found, learns: Option[CausticPaths]) extends SplatObserver:
    def observe(x: Float, y: Float, light: Rgb, misRatios: Double, edges: Int): Unit =
      val weighted = light.average.toDouble
      if weighted > 0.0 && weighted < Float.PositiveInfinity && findings.splatted.contains(x, y)
      then
        findings.splats += 1
        if learns.isDefined then
          for p <- learns do findings.learning.add(p.casterPosition, weighted)
        else
          // The weight is 1 / (1 + others); q/p of the light path
          val ratio =
            Math.min(if misRatios > 0.0 then 1.0 / Math.sqrt(misRatios) else MaxRatio, MaxRatio)
          findings.splatted.addSplat(x, y, weighted, weighted * (1.0 + misRatios), ratio)

  /** Samples of an image for which light paths shall pay. In media they seem to bring more than
    * they can, by light that is found once in a million samples. Elsewhere that light is most of
    * the gain where they pay, too.
    */
  private val imageSamples =
    if light.media.isDefined then PilotBlocks.UsualSamples else PilotBlocks.EndlessSamples

  private def expected(findings: Found, aimed: Casters): PilotResult =
    val cost =
      findings.lightRays.toDouble / Math.max(1, findings.lightPaths) / findings.pairs.raysPerPath
    val variances = findings.variances
    import variances.*
    // Rounded down to a power of two: docs/CAUSTICS.md
    val perSample = amount(Math.sqrt(byLight / (byPaths * cost)))
    val work = (byPaths + byLight / perSample) * (1.0 + cost * perSample)
    val choice = LightPathChoice(aimed, perSample.toFloat)
    PilotResult.of(choice, baseline = byPaths + excess, work, mustPay = !light.findsAll)

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
  inline val MaxRatio = 1e6

  /** A power of two, not above `best`, within bounds.
    *
    * @param best not a number where neither light paths nor the camera's find anything
    */
  def amount(best: Double): Double =
    if best > 0.0 then
      val power = Math.scalb(1.0, Math.getExponent(best))
      Math.max(MinPathsPerSample, Math.min(power, MaxPathsPerSample))
    else MinPathsPerSample
