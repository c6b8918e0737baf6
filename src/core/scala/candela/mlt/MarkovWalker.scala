package candela.mlt

import candela.bdpt.ChainPaths
import candela.io.{CheckedInput, CheckedOutput}
import candela.cameras.CameraRays
import candela.color.{Rgb, Wavelengths}
import candela.film.{Splats, View}
import candela.integrators.ChainWalker

/** Advances chains by the Metropolis rule (Metropolis et al., "Equation of State Calculations by
  * Fast Computing Machines", 1953), with expected-value splatting: each step splats both the
  * proposed and the current state, weighted by the acceptance probability.
  *
  * Large steps are also independent samples, combined with the chain's by the balance heuristic
  * (Kelemen et al. 2002, §4), so that dark regions, which chains rarely visit, have no more noise
  * than without chains.
  */
private[candela] final class MarkovWalker(
    tracer: Splats => ChainPaths,
    settings: MetropolisSettings,
    view: View,
    chains: MarkovChains
) extends ChainWalker:
  /** Splats of the last path. */
  val proposed: Contribution = Contribution(view)
  private val paths = tracer(proposed)
  private val rays = CameraRays(view.camera, view.shutter, view.differentialScale)

  /** Area of the sampled film region relative to the image. */
  private val share =
    ((view.x1.toDouble - view.x0) * (view.y1.toDouble - view.y0) / view.pixels).toFloat
  private val largeStep = settings.largeStep

  private var filmX, filmY = 0f
  var pending = 0f
  var discarded = 0L
  def x: Int = Math.floor(filmX).toInt
  def y: Int = Math.floor(filmY).toInt
  def raysTraced: Long = paths.raysTraced
  def lastMaterial: Int = paths.lastMaterial

  def prepare(isStopped: () => Boolean): Boolean =
    chains.prepare(this, isStopped)
    chains.start.isDefined

  def advance(chain: Int, paths: Long, weight: Float, isLeft: () => Boolean): Long =
    val start = chains.start.get
    pending = weight
    if start.mean > 0f then walk(chains(chain, start, this), start.mean, paths, isLeft)
    else
      var i = 0L
      while i < paths do
        view.splats.countSample()
        i += 1
      paths

  private def walk(chain: MarkovChain, mean: Float, count: Long, isLeft: () => Boolean): Long =
    val samples = chain.samples
    // Accumulated weight of the current state, splatted when the chain leaves it
    var currentWeight = pending
    var i = 0L
    while i < count && !isLeft() do
      view.splats.countSample()
      samples.propose()
      follow(samples)
      val oldStrength = chain.current.strength
      val newStrength = proposed.strength
      val accept = if newStrength >= oldStrength then 1f else newStrength / oldStrength
      currentWeight += (1f - accept) / (oldStrength / mean + largeStep)
      val draw = samples.uniform()
      val proposedWeight =
        (if samples.isLarge then accept + 1f else accept) / (newStrength / mean + largeStep)
      if draw < accept then
        chain.current.addTo(view.splats, currentWeight)
        samples.accept()
        chain.current.swap(proposed)
        currentWeight = proposedWeight
      else
        if newStrength > 0f then proposed.addTo(view.splats, proposedWeight)
        samples.reject()
      i += 1
    if i >= count then chain.current.addTo(view.splats, currentWeight) else pending = currentWeight
    i

  /** Evaluates a point of primary sample space into `proposed`. */
  def follow(samples: PrimarySamples): Unit =
    val s = samples.camera
    proposed.clear()
    s.next2D()
    filmX = view.x0 + s.x * (view.x1 - view.x0)
    filmY = view.y0 + s.y * (view.y1 - view.y0)
    val weight = rays.next(filmX, filmY, s)
    if weight > 0f then
      val light = paths.radiance(rays.ray, samples.light, samples.joins, s)
      if light.isFinite then proposed.add(filmX, filmY, light * (weight * share), 0)
      else discarded += 1

/** The splats of one point of [[PrimarySamples]]. Mutable. */
private[candela] final class Contribution(view: View) extends Splats:
  import Contribution.*
  private var data = new Array[Float](4 * Numbers)
  private var count = 0

  /** Total brightness: the target function of the chains. */
  var strength = 0f

  def clear(): Unit =
    count = 0
    strength = 0f

  /** Paths are counted by the chains. */
  def countSample(): Unit = ()

  /** The image has no groups of lights, … */
  def add(x: Float, y: Float, light: Rgb, group: Int): Unit =
    if x >= view.x0 && x < view.x1 && y >= view.y0 && y < view.y1 then
      val weight = Math.abs(light.luminance)
      if weight > 0f && weight < Float.PositiveInfinity then
        if (count + 1) * Numbers > data.length then
          data = java.util.Arrays.copyOf(data, 2 * data.length)
        val offset = count * Numbers
        data(offset) = x
        data(offset + 1) = y
        data(offset + 2) = light.r
        data(offset + 3) = light.g
        data(offset + 4) = light.b
        count += 1
        strength += weight

  /** … and no bands. */
  def addToBands(x: Float, y: Float, basis: Wavelengths, light: Rgb): Unit = ()

  def save(to: CheckedOutput): Unit =
    to.float(strength)
    to.int(count)
    for i <- 0 until count * Numbers do to.float(data(i))

  def load(from: CheckedInput): Unit =
    strength = from.float()
    count = from.count(bytes = 4 * Numbers)
    require(strength >= 0f && strength < Float.PositiveInfinity, s"a path's light is $strength")
    data = new Array[Float](Math.max(1, count) * Numbers)
    for i <- 0 until count * Numbers do data(i) = from.float()

  /** Swaps the contents with `other`. */
  def swap(other: Contribution): Unit =
    val (otherData, otherCount, otherStrength) = (other.data, other.count, other.strength)
    other.data = data
    other.count = count
    other.strength = strength
    data = otherData
    count = otherCount
    strength = otherStrength

  /** Adds the splats, times `weight`, to `splats`. */
  def addTo(splats: Splats, weight: Float): Unit =
    var offset = 0
    while offset < count * Numbers do
      val light = Rgb(data(offset + 2), data(offset + 3), data(offset + 4))
      splats.add(data(offset), data(offset + 1), light * weight, group = 0)
      offset += Numbers

private object Contribution:
  /** Floats per splat. */
  inline val Numbers = 5
