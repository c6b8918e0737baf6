package candela.bidirectional

import candela.base.loop
import candela.cameras.CameraRays
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
  * @param aim       photons that guide the camera's paths, if they do
  */
final case class CausticChoice(
    casters: Casters,
    perSample: Float,
    radius: Float = 0f,
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
  * @param tracer paths from the camera, weighted against light paths
  */
private[candela] final class CausticPilot(
    scene: Scene,
    view: View,
    light: CausticLight,
    tracer: CausticWeights => Integrator
):
  import CausticPilot.*
  private val blocks = PilotBlocks(view)
  private val pairs = CameraPairs(view, Seed + 2)
  private val learning = CasterLearning()
  private var isLearning = true
  private var splats = 0L
  private var cameraRays = 0.0

  /** @return the choice, if light paths pay; and why, or why not */
  def run(): (Option[CausticChoice], String) =
    if !isCameraWhereItSays then
      (None, "none: the first border of media before the camera says that it is in another medium")
    else look()

  private def look(): (Option[CausticChoice], String) =
    trace(light, LearningPaths, Seed): Unit
    if splats == 0 then
      val why = "no light path reaches the camera"
      // Manifold walks may find the light yet
      if !light.findsAll || light.media.isDefined || !scene.lights.exists(_.isDelta) then
        (None, s"none: $why")
      else
        (
          Some(CausticChoice(light.casters, Least.toFloat)),
          s"$why: manifold walks alone look for the light"
        )
    else
      isLearning = false
      val aimed = light.casters.aimed(learning.aim)
      val rays = trace(light.copy(casters = aimed), LookingPaths, Seed + 1)
      val integrator = tracer(CausticWeights(scene, aimed, view.camera, 1f))
      cameraRays = pairs.follow(Pairs, integrator, blocks)((_, _) => ())
      decide(aimed, rays)

  private def decide(aimed: Casters, rays: Double): (Option[CausticChoice], String) =
    val cost = rays / cameraRays
    val (byPaths, more, byLight) = blocks.variances()
    val best = Math.sqrt(byLight / (byPaths * cost))
    val perSample = Math.max(Least, Math.min(Math.scalb(1.0, Math.getExponent(best)), Most))
    val gain = gainOf(byPaths + more, (byPaths + byLight / perSample) * (1 + perSample * cost))
    val figures =
      f"the pilot expects ${times(gain)} times the efficiency, with $perSample%.3g light " +
        "paths per camera sample"
    if light.findsAll || gain > LeastGain then
      (Some(CausticChoice(aimed, perSample.toFloat)), figures)
    else (None, s"none: $figures")

  private def isCameraWhereItSays: Boolean =
    val within = light.within(scene)
    within == null || {
      val rays = CameraRays(view.camera, view.shutter, 0f)
      val sampler = IndependentSampler(1, Seed)
      (0 until CameraRaysLooked).forall: k =>
        pairs.start(sampler, k)
        val weight = rays.next(pairs.pixelX(k) + 0.5f, pairs.pixelY(k) + 0.5f, sampler)
        weight == 0f || !within.contradicts(rays.ray)
    }

  /** Traces light paths; returns the rays of each, on average. */
  private def trace(by: CausticLight, count: Int, seed: Int): Double =
    val within = by.within(scene)
    val paths = by.paths(scene, within)
    val observer = Observer(paths, count)
    val camera = CameraConnection(scene, view.camera, Splats.Discarded, within, 1f, observer)
    val sampler = IndependentSampler(1, seed)
    loop(count): k =>
      pairs.start(sampler, k)
      val time = view.shutter.fold(0f)(_.at(sampler.next1D()))
      camera.begin(time)
      paths.trace(time, sampler)
      camera.connect(paths, isWeighted = true, sampler)
    val inMedia = if within == null then 0L else within.raysTraced
    (paths.raysTraced + camera.raysTraced + inMedia).toDouble / count

  /** Adds what light paths find. */
  private final class Observer(paths: CausticPaths, count: Int) extends SplatObserver:
    private val scale = view.pixels / count

    def see(x: Float, y: Float, light: Rgb, others: Double): Unit =
      val weighted = light.average.toDouble
      if weighted > 0.0 && weighted < Float.PositiveInfinity && blocks.contains(x, y) then
        splats += 1
        if isLearning then learning.add(paths.place, weighted)
        else
          // The weight is 1 / (1 + others); q/p of the light path
          val ratio = if others > 0.0 then 1.0 / Math.sqrt(others) else MostRatio
          val whole = weighted * (1.0 + others)
          val rest = whole - weighted
          blocks.addSplat(
            x,
            y,
            weighted * scale,
            whole * whole * Math.min(ratio, MostRatio) * scale,
            rest * rest * Math.min(ratio, MostRatio) * scale,
            weighted * weighted * scale
          )

private[candela] object CausticPilot:
  inline val LearningPaths = 16384
  inline val LookingPaths = 16384
  inline val Pairs = 2048
  inline val CameraRaysLooked = 64
  inline val Seed = 0x5eed

  /** Light paths per camera sample. */
  inline val Least = 0.125
  inline val Most = 2.0

  /** What one light path finds must not decide alone. */
  inline val MostRatio = 1e6

  /** Expected efficiency from which on light paths are taken. The pilot is not exact: where
    * fireflies are left that no light path finds, it expects up to three times too much.
    */
  inline val LeastGain = 3.0

  /** The factor of efficiency, from variance times cost before and after; one where nothing is
    * noisy.
    */
  def gainOf(before: Double, after: Double): Double = if after > 0.0 then before / after else 1.0

  def times(gain: Double): String = if gain > 10.0 then "more than 10" else f"$gain%.2f"

/** Places on the film, in pixels, evenly spread for any number of them: the additive recurrence of
  * the plastic number.
  *
  * Source: Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018: his R₂.
  */
private[bidirectional] final class SpreadPlaces(view: View):
  def x(k: Int): Double = at(k, 0.7548776662466927, view.width)
  def y(k: Int): Double = at(k, 0.5698402909980532, view.height)
  private def at(k: Int, step: Double, size: Int): Double = ((k + 1) * step) % 1.0 * size

/** Blocks of the image, and the moments of what was found there. Mutable. */
private final class PilotBlocks(view: View):
  import PilotBlocks.*
  private val size = Math.max(1.0, Math.max(view.width, view.height) / Across)
  private val columns = Math.ceil(view.width / size).toInt
  private val rows = Math.ceil(view.height / size).toInt
  private val count = columns * rows
  private val pairs = new Array[Int](count)
  private val sum, spread, splat, alone, rest, own, saved = new Array[Double](count)

  def contains(x: Float, y: Float): Boolean =
    x >= 0f && y >= 0f && x < view.width && y < view.height

  /** Adds by how much the second moments of a pair of guided samples are below those of unguided
    * ones.
    */
  def addSaving(x: Int, y: Int, moment: Double): Unit = saved(block(x + 0.5f, y + 0.5f)) += moment

  private def block(x: Float, y: Float): Int =
    Math.min((y / size).toInt, rows - 1) * columns + Math.min((x / size).toInt, columns - 1)

  /** Adds two samples of a pixel. */
  def addPair(x: Int, y: Int, first: Float, second: Float): Unit =
    val i = block(x + 0.5f, y + 0.5f)
    pairs(i) += 1
    sum(i) += (first + second) * 0.5
    spread(i) += square((first - second).toDouble) * 0.5

  /** Adds light of a light path.
    *
    * @param light   of the whole block
    * @param byPaths second moment that paths from the camera would have alone
    * @param beside  that they have beside light paths
    * @param byLight that the light path has
    */
  def addSplat(
      x: Float,
      y: Float,
      light: Double,
      byPaths: Double,
      beside: Double,
      byLight: Double
  ): Unit =
    val i = block(x, y)
    splat(i) += light
    alone(i) += byPaths
    rest(i) += beside
    own(i) += byLight

  /** Relative variances of a sample, summed over blocks: of paths from the camera beside light
    * paths, what they have more without them, and that of light paths.
    */
  def variances(): (Double, Double, Double) =
    var byPaths, more, byLight = 0.0
    each: (i, unit, pixels) =>
      if pairs(i) > 0 then byPaths += unit * pixels * spread(i) / pairs(i)
      more += unit * (alone(i) - rest(i))
      byLight += unit * own(i)
    (byPaths, more, byLight)

  /** Likewise of guided paths, and what unguided ones have more. */
  def savings(): (Double, Double) =
    var guided, more = 0.0
    each: (i, unit, pixels) =>
      if pairs(i) > 0 then
        guided += unit * pixels * spread(i) / pairs(i)
        more += unit * pixels * saved(i) / (2 * pairs(i))
    (guided, more)

  /** Calls `use` with each block, the weight of its variance, and its size in pixels. */
  private def each(use: (Int, Double, Double) => Unit): Unit =
    val pixels = Array.tabulate(count): i =>
      val (w, h) = (view.width - (i % columns) * size, view.height - (i / columns) * size)
      Math.min(w, size) * Math.min(h, size)
    val means = Array.tabulate(count): i =>
      (if pairs(i) == 0 then 0.0 else sum(i) / pairs(i)) + splat(i) / pixels(i)
    val mean = means.sum / count
    loop(count)(i => use(i, 1.0 / (square(means(i)) + square(Floor * mean)), pixels(i)))

  private def square(x: Double): Double = x * x

private object PilotBlocks:
  /** Along the longer side. */
  inline val Across = 12.0

  /** Part of the mean brightness below which blocks count no more. */
  inline val Floor = 0.1
