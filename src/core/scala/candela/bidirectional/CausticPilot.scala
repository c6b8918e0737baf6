package candela.bidirectional

import candela.base.{Parallel, loop}
import candela.color.Rgb
import candela.film.{Splats, View}
import candela.integrators.{CausticWeights, Integrator}
import candela.sampling.{IndependentSampler, Sampler}
import candela.scene.{CasterLearning, Casters, Scene}

/** How light paths look for caustics.
  *
  * @param casters    where they begin, more often where caustics come from
  * @param perSample  light paths per camera sample, on average
  * @param ofEmitters the same of those that begin at emitters
  * @param radius     within which photons are gathered at first, if paths leave them caustics
  * @param bringsAll  do photons then bring all that media scatter to the camera?
  * @param aim        how light is found that specular surfaces show, if it is looked for
  */
final case class CausticChoice(
    casters: Casters,
    perSample: Float,
    ofEmitters: Float = 0f,
    radius: Float = 0f,
    bringsAll: Boolean = false,
    aim: Option[SeenLight] = None
):
  /** How many light paths there are. */
  def paths: String =
    val more = if ofEmitters > 0f then f", and $ofEmitters%.3g from emitters" else ""
    f"$perSample%.3g light paths per camera sample$more"

  def hasLightPaths: Boolean = perSample > 0f || ofEmitters > 0f

  private[candela] def weights(scene: Scene, view: View): CausticWeights =
    CausticWeights(scene, casters, view.camera, perSample, ofEmitters)

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
  * @param tracer paths from the camera, weighted against light paths, and those that look for light
  *               which specular surfaces show
  */
private[candela] final class CausticPilot(
    scene: Scene,
    view: View,
    light: CausticLight,
    pool: Parallel,
    tracer: (CausticWeights, Option[SeenLight]) => Integrator
):
  import CausticPilot.*

  /** What [[run]] chose by, if light paths reach the camera. */
  private var looked: Option[Found] = None

  /** @return the choice, if light paths pay; and why, or why not */
  def run(): (Option[CausticChoice], String) =
    if !light.isCameraWhereItSays(scene, view) then (None, CausticPilot.CameraElsewhere)
    else
      val learnt = traced(light, LightKind.OfCasters, 0, LearningPaths, Seed, isLearning = true)
      if learnt.splats == 0 then withoutSplats else look(light.casters.aimed(learnt.learning.aim))

  /** The choice of [[run]] with as many light paths as suit camera paths that look for light which
    * specular surfaces show. The first round of these decides: specks that few find would hide what
    * light paths bring.
    */
  def balanced(choice: CausticChoice): CausticChoice = looked.fold(choice): found =>
    val kinds = LightKind.values.toVector.take(if choice.ofEmitters > 0f then 2 else 1)
    val beside = found.beside(followed(choice.casters, kinds, 0, 1, choice.aim))
    val expected = Expected.of(beside, kinds, choice.aim.fold(1.0)(_.overhead))
    expected.choice(choice.casters).copy(aim = choice.aim)

  private def withoutSplats: (Option[CausticChoice], String) =
    val why = "no light path reaches the camera"
    // Manifold walks may find the light yet
    if !light.findsAll || light.media.isDefined || !scene.lights.exists(_.isDelta) then
      (None, s"none: $why")
    else
      val few = CausticChoice(light.casters, BesideWalks.toFloat)
      (Some(few), s"$why: manifold walks look for the light, and ${few.paths}")

  private def look(aimed: Casters): (Option[CausticChoice], String) =
    val (kinds, found) = ofKinds(aimed)
    val first = Expected.of(found, kinds)
    val expected =
      if light.findsAll || !first.pays then first
      else
        found.add(look(aimed, kinds, 1, Rounds))
        Expected.of(found, kinds)
    looked = Some(found)
    if light.findsAll || expected.pays then (Some(expected.choice(aimed)), expected.toString)
    else (None, s"none: $expected")

  /** Which light paths are taken, if any are: those from emitters, too, if that seems better; and
    * what the first round finds.
    */
  private def ofKinds(aimed: Casters): (Vector[LightKind], Found) =
    def first(kinds: Vector[LightKind]) = (kinds, look(aimed, kinds, 0, 1))
    def gain(kinds: Vector[LightKind], found: Found) = Expected.of(found, kinds).gain
    val few = first(Vector(LightKind.OfCasters))
    if !light.beginsAtEmitters(scene) then few
    else
      val all = first(LightKind.values.toVector)
      if gain.tupled(all) > LeastGainOfMore * gain.tupled(few) then all else few

  /** What light paths and the camera's paths of some rounds find. */
  private def look(aimed: Casters, kinds: Vector[LightKind], from: Int, until: Int): Found =
    val by = light.copy(casters = aimed)
    val found = Found()
    for kind <- kinds do
      found.add(
        traced(by, kind, from * LookingPaths, until * LookingPaths, Seed + 1, isLearning = false)
      )
    found.pairs.add(followed(aimed, kinds, from, until, None))
    found

  /** What the camera's paths, perhaps guided, of some rounds find beside light paths. */
  private def followed(
      aimed: Casters,
      kinds: Vector[LightKind],
      from: Int,
      until: Int,
      aim: Option[SeenLight]
  ): PilotBlocks =
    val ofEmitters = if kinds.contains(LightKind.OfEmitters) then 1f else 0f
    val weights = CausticWeights(scene, aimed, view.camera, 1f, ofEmitters)
    CameraPairs.followed(view, Seed + 2, pool, from * Pairs, until * Pairs): _ =>
      (tracer(weights, aim), (_, _) => ())

  /** What the light paths `from` to `until` find. */
  private def traced(
      by: CausticLight,
      kind: LightKind,
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
        part.trace(by, kind, from + i * each, from + (i + 1) * each, seed, isLearning)
        part
      .foreach(found.add)
    found

  /** What some of the paths found. Mutable. */
  private final class Found:
    /** Of light paths, and of the camera's paths beside them. */
    val splatted, pairs = PilotBlocks(view)
    val learning = CasterLearning()
    var splats = 0L

    /** Of each kind of light paths. */
    val lightRays = new Array[Long](LightKind.values.length)
    val lightPaths = new Array[Int](lightRays.length)

    def add(other: Found): Unit =
      pairs.add(other.pairs)
      addLight(other)

    private def addLight(other: Found): Unit =
      splatted.add(other.splatted)
      learning.addAll(other.learning)
      splats += other.splats
      loop(lightRays.length): k =>
        lightRays(k) += other.lightRays(k)
        lightPaths(k) += other.lightPaths(k)

    /** The same light paths, beside other paths from the camera. */
    def beside(others: PilotBlocks): Found =
      val found = Found()
      found.addLight(this)
      found.pairs.add(others)
      found

    def variances(usual: Double): PilotBlocks.Variances =
      val all = PilotBlocks(view)
      all.add(splatted)
      all.add(pairs)
      all.variances(lightPaths(0), usual)

    def trace(
        by: CausticLight,
        kind: LightKind,
        from: Int,
        until: Int,
        seed: Int,
        isLearning: Boolean
    ): Unit =
      val within = by.within(scene)
      kind match
        case LightKind.OfCasters =>
          val paths = by.paths(scene, within)
          val observer = Observer(kind, this, if isLearning then Some(paths) else None)
          trace(paths, within, kind, observer, from, until, seed)(paths.trace(_, _))
        case LightKind.OfEmitters =>
          val paths = by.emitterPaths(scene, within)
          trace(paths, within, kind, Observer(kind, this, None), from, until, seed):
            (time, sampler) =>
              paths.trace(time, sampler, hero = (sampler.next1D() * 3f).toInt)

    private def trace(
        paths: LightVertices,
        within: PathMedia | Null,
        kind: LightKind,
        observer: Observer,
        from: Int,
        until: Int,
        seed: Int
    )(next: (Float, Sampler) => Unit): Unit =
      val camera = CameraConnection(scene, view.camera, Splats.Discarded, within, observer)
      val sampler = IndependentSampler(1, seed)
      loop(from, until): k =>
        CameraPairs.start(view, sampler, k)
        val time = view.shutter.fold(0f)(_.at(sampler.next1D()))
        camera.begin(time)
        next(time, sampler)
        camera.connect(paths, isWeighted = true, sampler)
      val inMedia = if within == null then 0L else within.raysTraced
      lightRays(kind.ordinal) += paths.raysTraced + camera.raysTraced + inMedia
      lightPaths(kind.ordinal) += until - from

  /** Adds what light paths find.
    *
    * @param learns from these paths where they begin, if at all
    */
  private final class Observer(kind: LightKind, found: Found, learns: Option[CausticPaths])
      extends SplatObserver:
    def see(x: Float, y: Float, light: Rgb, others: Double): Unit =
      val weighted = light.average.toDouble
      if weighted > 0.0 && weighted < Float.PositiveInfinity && found.splatted.contains(x, y) then
        found.splats += 1
        if learns.isDefined then for p <- learns do found.learning.add(p.place, weighted)
        else
          // The weight is 1 / (1 + others); q/p of the light path
          val ratio =
            Math.min(if others > 0.0 then 1.0 / Math.sqrt(others) else MostRatio, MostRatio)
          found.splatted.addSplat(x, y, kind, weighted, weighted * (1.0 + others), ratio)

  /** Samples of an image for which light paths shall pay. Where they may begin at emitters, those
    * of casters alone seem to bring more than any can, by light that is found once in a million
    * samples. Elsewhere that light is most of the gain where they pay, too.
    */
  private lazy val usual =
    if light.beginsAtEmitters(scene) then PilotBlocks.UsualSamples else PilotBlocks.EndlessSamples

  /** What is expected of light paths.
    *
    * @param gain      factor of efficiency
    * @param perSample light paths of each kind per camera sample, for the greatest
    */
  private final class Expected(val gain: Double, perSample: Vector[Double]):
    def pays: Boolean = gain > LeastGain

    def choice(aimed: Casters): CausticChoice =
      CausticChoice(aimed, perSample(0).toFloat, perSample(1).toFloat)

    override def toString: String =
      s"the pilot expects ${times(gain)} times the efficiency, with ${choice(light.casters).paths}"

  private object Expected:
    /** @param overhead time of a ray of the camera's paths, relative to that of unguided ones */
    def of(found: Found, kinds: Vector[LightKind], overhead: Double = 1.0): Expected =
      val cost = found.lightRays.indices.map: k =>
        found.lightRays(k).toDouble / Math.max(1, found.lightPaths(k)) / found.pairs.raysPerPath
      val variances = found.variances(usual)
      import variances.*
      // To the nearest power of two in media; elsewhere down, as the ring of docs/CAUSTICS.md asks
      val ample = if kinds.contains(LightKind.OfEmitters) then Math.sqrt(2.0) else 1.0
      val perSample = LightKind.values.toVector.map: kind =>
        val k = kind.ordinal
        val best = ample * Math.sqrt(overhead * byLight(k) / (byPaths * cost(k)))
        if kinds.contains(kind) then amount(best) else 0.0
      val byAll = byLight.lazyZip(perSample).map((v, n) => if n > 0.0 then v / n else 0.0).sum
      val costs = overhead + cost.lazyZip(perSample).map(_ * _).sum
      Expected(gainOf(byPaths + without, (byPaths + byAll) * costs), perSample)

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

  /** Bounds of the light paths per camera sample. */
  inline val MinPathsPerSample = 1.0 / 64
  inline val MaxPathsPerSample = 16.0

  /** The same beside manifold walks, where the pilot's find nothing. What others then find counts
    * as many times as they are few.
    */
  inline val BesideWalks = 1.0 / 8

  /** What one light path finds must not decide alone. */
  inline val MostRatio = 1e6

  /** Expected efficiency from which on light paths are taken. The pilot is not exact: what paths
    * would have found once in a billion samples counts for it, too, and fireflies that no light
    * path finds may be missed.
    */
  inline val LeastGain = 3.0

  /** Times the efficiency, from which on paths from emitters are taken beside those from
    * casters.
    */
  inline val LeastGainOfMore = 1.2

  /** A power of two, not above `best`, within bounds.
    *
    * @param best not a number where neither light paths nor the camera's find anything
    */
  def amount(best: Double): Double =
    if best > 0.0 then
      val power = Math.scalb(1.0, Math.getExponent(best))
      Math.max(MinPathsPerSample, Math.min(power, MaxPathsPerSample))
    else MinPathsPerSample

  /** The factor of efficiency, from variance times cost before and after; one where nothing is
    * noisy.
    */
  def gainOf(before: Double, after: Double): Double = if after > 0.0 then before / after else 1.0

  def times(gain: Double): String = if gain > 10.0 then "more than 10" else f"$gain%.2f"
