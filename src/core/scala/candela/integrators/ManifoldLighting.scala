package candela.integrators

import candela.color.{MutableRgb, Rgb}
import candela.lights.LightSample
import candela.manifold.SpecularChain
import candela.sampling.{Discrete, RandomStream, Sampler}
import candela.scene.Scene

/** Light that comes to a surface by chains of specular surfaces: a manifold walk finds one chain,
  * and how often others find the same one estimates its probability. Mutable, one per worker.
  *
  * Source: Zeltner, Georgiev and Jakob 2020, §4.2; see [[candela.manifold.SpecularChain]].
  */
private[integrators] final class ManifoldLighting(scene: Scene, manifolds: Manifolds):
  private val chain = SpecularChain(scene)
  private val random = RandomStream()
  private val sample = LightSample()
  private val met = scene.newPoint()
  private val passed = MutableRgb()
  private var light = -1

  /** Probability of the lamp. */
  private var chance = 0f

  /** What [[finds]] has found, not yet weighted with the path's throughput. */
  val arrived: MutableRgb = MutableRgb()

  /** The lamp that sends it. */
  def index: Int = light

  def raysTraced: Long = chain.raysTraced

  /** Looks for light that `vertex` scatters to its `wo`. The sampler stays where it is. */
  def finds(vertex: SurfaceVertex, path: PathState, time: Float, sampler: Sampler): Boolean =
    val position = sampler.position
    random.seed(sampler.next1D(), sampler.next1D())
    sampler.goTo(position)
    val lamps = manifolds.lamps
    lamps != null && chooseLamp(lamps, vertex) && {
      chain.begin(vertex.at, time, manifolds.maxDepth - path.depth)
      chain.find(random) && lights(vertex, path) && {
        chain.keep()
        arrived.scale(trials())
        true
      }
    }

  private def chooseLamp(lamps: Discrete, vertex: SurfaceVertex): Boolean =
    light = lamps.sample(random.next())
    val (u1, u2) = (random.next(), random.next())
    scene.lights(light).sample(vertex.at.p, u1, u2, sample)
    chance = lamps.probability(light)
    chain.aim(if sample.isInfinite then sample.wi else sample.target.p, sample.isInfinite)
    // Others are surfaces that rays do not meet
    sample.pdf == 1f && (sample.isInfinite || sample.target.n.isZero)

  /** Computes what the chain brings: false if nothing. */
  private def lights(vertex: SurfaceVertex, path: PathState): Boolean =
    val wi = chain.direction
    val localWi = vertex.at.frame.toLocal(wi)
    val f = vertex.received(wi, localWi)
    !f.isBlack && {
      chain.throughput(passed)
      val sent = if passed.isBlack then Rgb.Black else emitted
      val factor = (chain.spread * Math.abs(localWi.z) / chance).toFloat
      if scene.isDispersive && !path.isAlone && chain.isDispersive then
        passed.scale(LightTransport.Hero)
      passed.scale(f * sent)
      passed.scale(factor)
      arrived.set(passed.toRgb)
      !arrived.isBlack && factor < Float.PositiveInfinity
    }

  /** Intensity of the lamp towards the chain, or irradiance. */
  private def emitted: Rgb =
    if !chain.escapes(met) then Rgb.Black
    else
      scene.lights(light).sample(chain.end, 0f, 0f, sample)
      if sample.pdf != 1f then Rgb.Black
      else if sample.isInfinite then sample.radiance.toRgb
      else sample.radiance.toRgb * (sample.target.p - chain.end).lengthSquared

  /** How many walks it takes to find the chain again: the mean is the inverse of the probability.
    */
  private def trials(): Float =
    var count = 1
    while count < ManifoldLighting.Most && !(chain.find(random) && chain.isSame) do count += 1
    count.toFloat

private object ManifoldLighting:
  /** Chains that fewer than one walk in as many finds are too dark. */
  private inline val Most = 100000
