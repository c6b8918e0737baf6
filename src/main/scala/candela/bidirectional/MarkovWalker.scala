package candela.bidirectional

import candela.cameras.CameraRays
import candela.film.{Splats, View}
import candela.integrators.ChainWalker

/** Takes chains on by the rule of Metropolis et al. ("Equation of State Calculations by Fast
  * Computing Machines", 1953), and hands what they find to the film by its expected value: each
  * step pays both where it may go and where it may stay, by the probability of each.
  *
  * Paths that were all new are independent samples, too, and are combined with the chain's by the
  * balance heuristic (Kelemen et al. 2002, §4): so what is dark, where chains come seldom, has no
  * more noise than without them.
  */
private[bidirectional] final class MarkovWalker(
    tracer: Splats => BidirectionalPathTracer,
    settings: MetropolisSettings,
    view: View,
    chains: MarkovChains
) extends ChainWalker:
  /** What the last path has brought. */
  val proposed: Contribution = Contribution(view)
  private val paths = tracer(proposed)
  private val rays = CameraRays(view.camera, view.shutter, view.differentialScale)

  /** Camera paths are chosen on a part of the film, or on more than the film. */
  private val share =
    ((view.x1.toDouble - view.x0) * (view.y1.toDouble - view.y0) / view.pixels).toFloat
  private val largeStep = settings.largeStep

  private var filmX, filmY = 0f
  var refused = 0L
  def x: Int = Math.floor(filmX).toInt
  def y: Int = Math.floor(filmY).toInt
  def raysTraced: Long = paths.raysTraced
  def lastMaterial: Int = paths.lastMaterial

  def begin(isStopped: () => Boolean): Boolean =
    chains.begin(this, isStopped)
    chains.start.isDefined

  def advance(chain: Int, paths: Long): Unit =
    val start = chains.start.get
    if start.mean > 0f then walk(chains(chain, start, this), start.mean, paths)
    else
      var i = 0L
      while i < paths do
        view.splats.begin()
        i += 1

  private def walk(chain: MarkovChain, mean: Float, count: Long): Unit =
    val samples = chain.samples
    // What the current path is paid once the chain leaves it
    var stay = 0f
    var i = 0L
    while i < count do
      view.splats.begin()
      samples.propose()
      follow(samples)
      val here = chain.current.strength
      val there = proposed.strength
      val accept = if there >= here then 1f else there / here
      stay += (1f - accept) / (here / mean + largeStep)
      val draw = samples.uniform()
      val pay = (if samples.isLarge then accept + 1f else accept) / (there / mean + largeStep)
      if draw < accept then
        chain.current.addTo(view.splats, stay)
        samples.accept()
        chain.current.exchange(proposed)
        stay = pay
      else
        if there > 0f then proposed.addTo(view.splats, pay)
        samples.reject()
      i += 1
    chain.current.addTo(view.splats, stay)

  /** Finds all that the point stands for, and leaves it in `proposed`. */
  def follow(samples: PrimarySamples): Unit =
    val s = samples.camera
    proposed.clear()
    s.next2D()
    filmX = view.x0 + s.x * (view.x1 - view.x0)
    filmY = view.y0 + s.y * (view.y1 - view.y0)
    val weight = rays.next(filmX, filmY, s)
    if weight > 0f then
      val light = paths.radiance(rays.ray, samples.light, samples.joins, s)
      if light.isFinite then proposed.add(filmX, filmY, light * (weight * share))
      else refused += 1
