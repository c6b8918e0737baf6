package candela.integrators

import candela.color.{MutableRgb, Rgb}
import candela.geometry.Hit
import candela.guiding.{GuideField, PhotonMixture}
import candela.lights.LightSample
import candela.manifold.{Coverage, SpecularChain}
import candela.math.*
import candela.sampling.{Discrete, RandomStream, Sampler}
import candela.scene.Scene
import candela.shapes.SurfaceSample

/** Light that comes to a surface by chains of specular surfaces: a manifold walk finds one chain,
  * and how often others find the same one estimates its probability. Mutable, one per worker.
  *
  * To area lights, walks begin in directions that photons came from: any direction has
  * a probability, as lobes have tails.
  *
  * Source: Zeltner, Georgiev and Jakob 2020, §4.2; see [[candela.manifold.SpecularChain]].
  */
private[integrators] final class ManifoldLighting(scene: Scene, manifolds: Manifolds):
  private val chain = SpecularChain(scene)
  private val coverage = Coverage(scene)
  private val random = RandomStream()
  private val lobes = PhotonMixture()
  private val seed = MutableVec3()
  private val place = SurfaceSample()
  private val sample = LightSample()
  private val met = scene.newPoint()
  private val passed = MutableRgb()
  private var light = -1

  /** Are there lobes at the vertex? */
  private var isSeeded = false

  /** Is it an area light? */
  private var isSurface = false

  /** Per area of the light, or 1 for delta lights, times the probability of the light. */
  private var density = 0f

  /** What a path finds that meets the emitter by chance, relative to what the chain brings. */
  private var rarity = 0.0

  /** What [[finds]] has found, not yet weighted with the path's throughput. */
  val arrived: MutableRgb = MutableRgb()

  /** The emitter that sends it. */
  def index: Int = light

  def raysTraced: Long = chain.raysTraced

  /** The path has come to a vertex, where nothing was looked for yet. */
  def arrive(): Unit = isSeeded = false

  /** Looks for light that `vertex` scatters to its `wo`. The sampler stays where it is. */
  def finds(vertex: SurfaceVertex, path: PathHistory, time: Float, sampler: Sampler): Boolean =
    val position = sampler.position
    random.seed(sampler.next1D(), sampler.next1D())
    sampler.goTo(position)
    locate(vertex)
    val share =
      if path.chain == Manifolds.SpecularFromCamera then 1f
      else ManifoldLighting.IndirectProbability
    (share == 1f || random.next() < share) && chooseEmitter(vertex) && {
      chain.begin(vertex.at, time, manifolds.maxDepth - path.depth)
      finds() && lights(vertex, path) && {
        val alone = path.carried(arrived.toRgb, 1f).average
        val chance = if isSurface then manifolds.chance(alone) else 1f
        (chance == 1f || random.next() < chance) && {
          chain.keep()
          val walks = trials() / (share * chance)
          arrived.scale(walks)
          val tally = manifolds.tally
          if tally != null && isSurface then tally.add(light, alone, walks, rarity)
          true
        }
      }
    }

  private def locate(vertex: SurfaceVertex): Unit =
    val field = manifolds.seeds
    isSeeded = field != null && {
      val n = vertex.at.frame.n
      val side = GuideField.side(if vertex.localWo.z < 0f then -n else n.toVec3)
      lobes.locate(field, vertex.at.p, side)
    }

  private def chooseEmitter(vertex: SurfaceVertex): Boolean =
    val points = manifolds.points
    val surfaces = if isSeeded then manifolds.surfaces else null
    if points != null && surfaces != null then
      if random.next() < 0.5f then choosePoint(points, 0.5f, vertex)
      else chooseSurface(surfaces, 0.5f)
    else if surfaces != null then chooseSurface(surfaces, 1f)
    else points != null && choosePoint(points, 1f, vertex)

  private def chooseSurface(emitters: Discrete, chance: Float): Boolean =
    light = emitters.sample(random.next())
    isSurface = true
    val emitter = scene.lights(light).asSurface
    emitter != null && {
      emitter.samplePlace(random.next(), random.next(), place)
      density = place.pdf * chance * emitters.probability(light)
      chain.aim(place.p, isDirection = false)
      density > 0f
    }

  private def choosePoint(emitters: Discrete, chance: Float, vertex: SurfaceVertex): Boolean =
    light = emitters.sample(random.next())
    isSurface = false
    scene.lights(light).sample(vertex.at.p, random.next(), random.next(), sample)
    density = chance * emitters.probability(light)
    chain.aim(if sample.isInfinite then sample.wi else sample.target.p, sample.isInfinite)
    // Others are surfaces that rays do not meet
    sample.pdf == 1f && (sample.isInfinite || sample.target.n.isZero)

  /** Walks once. */
  private def finds(): Boolean =
    if isSurface then
      lobes.sample(random.next(), random.next(), seed)
      chain.findAlong(seed, random)
    else chain.find(random)

  /** Computes what the chain brings: false if nothing. */
  private def lights(vertex: SurfaceVertex, path: PathHistory): Boolean =
    val wi = chain.direction
    val localWi = vertex.at.frame.toLocal(wi)
    val f = if isTaken(vertex, localWi) then vertex.received(wi, localWi) else Rgb.Black
    !f.isBlack && {
      chain.throughput(passed)
      val radiance = if passed.isBlack then Rgb.Black else emitted
      val factor = (chain.spread * Math.abs(localWi.z) / density).toFloat
      if scene.isDispersive && !path.isAlone && chain.isDispersive then
        passed.scale(LightTransport.Hero)
      passed.scale(f * radiance)
      passed.scale(factor)
      arrived.set(passed.toRgb)
      if manifolds.tally != null && isSurface then
        val cosine = met.geometricNormal absDot chain.toEmitter
        val byChance = vertex.localPdf(localWi).toDouble * chain.probability * cosine * chain.spread
        rarity = if byChance > 0.0 then density / byChance else 0.0
      !arrived.isBlack && factor < Float.PositiveInfinity
    }

  /** May a path take the direction? Those that meet a surface leave to walks what they may find. */
  private def isTaken(vertex: SurfaceVertex, localWi: Vec3): Boolean =
    !isSurface || !vertex.crosses(localWi) ||
      vertex.bsdf.isTransmissive && !scene.isSubsurface(vertex.at.material)

  /** Radiance of the emitter towards the chain, times the cosine there; of others, their intensity
    * or irradiance.
    */
  private def emitted: Rgb =
    val emitter = scene.lights(light)
    val surface = emitter.asSurface
    val to = chain.toEmitter
    if surface != null then
      if !chain.reaches(light, met) || !isSameSide(to) then Rgb.Black
      else surface.radiance(met, -to) * (met.geometricNormal absDot to)
    else if !chain.escapes(met) then Rgb.Black
    else
      emitter.sample(chain.end, 0f, 0f, sample)
      if sample.pdf != 1f then Rgb.Black
      else if sample.isInfinite then sample.radiance.toRgb
      else sample.radiance.toRgb * (sample.target.p - chain.end).lengthSquared

  /** Has the ray met the side of the emitter where the place is? Both are near each other on a tiny
    * emitter that is curved.
    */
  private def isSameSide(to: Vec3): Boolean =
    (place.n dot to) * (met.geometricNormal dot to) > 0f

  /** How many walks it takes to find the chain again: the mean is the inverse of the probability.
    */
  private def trials(): Float =
    var count = 1
    while count < manifolds.most && !(finds() && chain.isSame) do count += 1
    count.toFloat

  /** The path leaves the vertex by `vertex.bounce`. */
  def leave(vertex: SurfaceVertex, hit: Hit, path: PathHistory): Unit =
    manifolds.leave(vertex, hit, path, coverage, isSeeded)

private object ManifoldLighting:
  /** Probability of a walk at a vertex that the camera does not see through specular surfaces
    * only: such a vertex matters less.
    */
  private inline val IndirectProbability = 0.25f
