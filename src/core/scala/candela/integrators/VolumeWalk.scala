package candela.integrators

import candela.bsdf.Bssrdf
import candela.color.{MutableRgb, Rgb}
import candela.film.LightParts
import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.media.{MediumWork, PathWeights, SceneMedia}
import candela.sampling.{PhaseFunction, Sampler}
import candela.scene.Scene

/** A path from the camera through participating media: its state, and the steps of which
  * [[VolumePathTracer]] is made. As [[Walk]], but the throughput and the densities of sampling are
  * kept for each colour, since media scatter colours with different densities
  * ([[candela.media.PathWeights]]). Mutable, one per worker.
  */
class VolumeWalk(
    scene: Scene,
    media: SceneMedia,
    options: WalkOptions,
    sharedParts: LightParts | Null = null
) extends CameraPath:
  /** Light found so far, but for what media emit. */
  final val radiance: MutableRgb = MutableRgb()

  private val work = MediumWork()

  /** Throughput, density of the path, and density with which light sampling would have made it. */
  protected final val weights: PathWeights = work.weights

  /** Scattering events so far, in media and on surfaces. */
  var depth: Int = 0

  /** As [[Walk.etaScale]]. */
  var etaScale: Float = 1f

  /** Has the path been scattered other than by specular surfaces? Followed only if paths are
    * regularized.
    */
  var isSpread: Boolean = false

  /** Index of the medium around the path, −1: none. */
  var medium: Int = -1

  var goesOn: Boolean = false

  /** Where the path is, if on a surface. */
  final val vertex: SurfaceVertex = SurfaceVertex(scene)

  /** Next-event estimation. */
  final val light: LightConnection = LightConnection(scene)

  // Where the current direction was sampled
  private val lastP, lastN = MutableVec3()

  private var ray = Ray()
  private val hit = Hit()
  private var rays = 0L
  private val crossesPanes = options.crossesPanes && scene.hasPanes
  private val visibility = MediumVisibility(scene, media, work, crossesPanes)
  private val regularizes = options.regularizes
  private val hidesLamps = options.hidesLamps
  private val samplesLights = options.samplesLights && scene.lights.length > 0
  private val disperses = scene.isDispersive

  /** As [[Walk.parts]]. */
  val parts: LightParts | Null =
    if sharedParts != null then sharedParts else scene.lightGroups.map(LightParts(_)).orNull
  private val probe: SubsurfaceProbe | Null =
    if options.subsurface then SubsurfaceProbe(scene) else null

  def raysTraced: Long =
    val beneath = probe
    rays + visibility.raysTraced + (if beneath == null then 0L else beneath.raysTraced)

  /** Starts a path along a camera ray, which the walk overwrites. */
  def begin(cameraRay: Ray, sampler: Sampler): Unit =
    ray = cameraRay
    work.start(hero = if media.isChromatic then (sampler.next1D() * 3f).toInt else 0)
    work.random.seed(sampler.next1D(), sampler.next1D())
    visibility.start(ray.time)
    radiance.set(Rgb.Black)
    if parts != null then parts.clear()
    medium = media.camera
    depth = 0
    etaScale = 1f
    isSpread = false
    goesOn = true

  def end(): Unit = goesOn = false

  /** As [[Walk.keep]]. */
  protected final def keep(to: VolumeWalk.State): Unit =
    to.weights.set(weights)
    to.depth = depth
    to.etaScale = etaScale
    to.medium = medium
    to.isSpread = isSpread
    to.from.set(lastP, lastN, ray)

  /** As [[Walk.goOn]]. */
  protected final def goOn(from: VolumeWalk.State): Unit =
    weights.set(from.weights)
    depth = from.depth
    etaScale = from.etaScale
    medium = from.medium
    isSpread = from.isSpread
    from.from.restore(lastP, lastN, ray)
    goesOn = true

  /** All light found, with what media emitted towards the camera. */
  def total: Rgb = radiance.toRgb + glow

  private def glow: Rgb = Rgb(work.glowR, work.glowG, work.glowB)

  /** Traces the ray to the next surface; false if it leaves the scene. */
  def intersect(): Boolean =
    rays += 1
    scene.closest(ray, hit)

  /** Samples a collision with the medium before that surface, and attenuates the path up to there.
    *
    * @return the ray's parameter of a scattering event; −1: none
    */
  def sampleMedium(emits: Boolean, sampler: Sampler): Float =
    if medium < 0 then -1f
    else
      val t = media.media(medium).follow(ray, sampler.next1D(), emits, work)
      if parts != null then parts.addGlowUpTo(depth, glow)
      t

  /** Was the path absorbed? */
  def isAbsorbed: Boolean = weights.isDead

  /** Goes to the surface that [[intersect]] found. */
  def meetSurface(): Unit = vertex.hit(ray, hit)

  /** Adds the environment's radiance and ends the path. Weight: scattering against light sampling.
    */
  def addEnvironment(): Unit =
    if !hidesLamps || depth > 0 then
      val arriving = weights.throughput
      val found = LightTransport.environment(
        scene,
        ray,
        (i, source) => emissionWeight(i, source.pdf(lastP, ray.direction)),
        (i, light) => if parts != null then parts.addEnvironment(i, depth, arriving * light)
      )
      radiance.add(arriving * found)
    end()

  /** Adds what the surface emits. Weight: scattering against light sampling. */
  def addEmission(): Unit =
    val at = vertex.at
    if at.areaLight >= 0 && !isHidden then
      val source = scene.surfaceLight(at)
      val emitted = source.radiance(at, vertex.wo)
      if !emitted.isBlack then
        val weight =
          if source.isShownOnly then shownWeight
          else emissionWeight(at.areaLight, source.pdf(lastP, at))
        val found = weights.throughput * (emitted * weight)
        radiance.add(found)
        if parts != null then parts.addLight(at.areaLight, depth, found)

  /** Of light that only the camera and specular scattering see. */
  private def shownWeight: Float = if weights.lightDensity > 0f then 0f else 1f

  /** @param pointPdf solid-angle density with which light sampling finds the point of the light */
  private inline def emissionWeight(light: Int, inline pointPdf: Float): Float =
    // In units of the path's own density
    val density = weights.lightDensity
    if density > 0f then
      val chosen = scene.selection.probability(lastP, lastN, light)
      LightTransport.powerHeuristic(1f, density * chosen * pointPdf)
    else 1f

  /** As [[Walk.isPassed]]. */
  def isPassed: Boolean = vertex.isInterface || isHidden

  private def isHidden = hidesLamps && depth == 0 && vertex.at.areaLight >= 0

  /** Continues through an interface. Light sampling passes it, too, and goes on competing. */
  def passThrough(): Unit =
    medium = media.beyond(vertex.at, ray.direction, medium)
    vertex.passThrough(ray)

  /** Is the surface a pane that paths cross? */
  def isAtPane: Boolean = crossesPanes && scene.isPane(vertex.at)

  /** Evaluates the BSDF of a pane: a scattering event, unless the path crosses it. */
  def meetPane(): Unit =
    depth += 1
    vertex.evaluate()

  /** Continues through a pane, as through an interface, or is scattered. */
  def crossPane(sampler: Sampler): Unit =
    scatter(sampler)
    if vertex.isStraight then
      depth -= 1
      passThrough()
      goesOn = !isAbsorbed
    else leave()

  /** Scatters the path at parameter `t` of the ray, having added direct light there. */
  def scatterInMedium(t: Float, sampler: Sampler): Unit =
    depth += 1
    val p = ray.at(t)
    val wo = -ray.direction
    val phase = media.media(medium).phase
    arrive(p, wo)
    if samplesLights then
      val choice = sampler.next1D(matters = light.isRandom)
      sampler.next2D()
      if light.choose(p, Vec3.Zero, choice) && light.samplePoint(p, sampler.x, sampler.y) then
        val value = phase.value(wo, light.wi)
        if visibility.reaches(p, light.sample, medium) then
          add(arriving(phasePdf(value)) * value)
    turn(phase, p, wo, sampler)

  /** The path is scattered at `p` in the medium. */
  protected def arrive(p: Vec3, wo: Vec3): Unit = ()

  /** Solid-angle density with which [[turn]] takes the direction of the light sample, given the
    * phase function's.
    */
  protected def phasePdf(value: Float): Float = value

  /** Samples the phase function at `p`, and leaves in that direction. */
  protected def turn(phase: PhaseFunction, p: Vec3, wo: Vec3, sampler: Sampler): Unit =
    sampler.next2D()
    val wi = phase.sample(wo, sampler.x, sampler.y)
    leaveInMedium(p, wi, phase.value(wo, wi))

  /** Leaves a place in the medium, or ends.
    *
    * @param pdf solid-angle density of the direction
    */
  protected final def leaveInMedium(p: Vec3, wi: Vec3, pdf: Float): Unit =
    weights.turn(if options.samplesLights then pdf else 0f)
    lastP.set(p)
    lastN.set(Vec3.Zero)
    ray.set(p, wi, Float.PositiveInfinity)
    ray.differential.isKnown = false
    isSpread = options.regularizes
    goesOn = !isAbsorbed

  /** Evaluates the BSDF of the vertex: a scattering event. */
  def evaluate(): Unit =
    depth += 1
    vertex.evaluate(isSpread)
    if disperses && !weights.isAlone && vertex.bsdf.isDispersive then weights.keepHero()

  /** Chooses one light and samples a point on it; false if it contributes nothing. */
  def sampleOneLight(sampler: Sampler): Boolean =
    val choice = sampler.next1D(matters = light.isRandom)
    sampler.next2D()
    val p = vertex.at.p
    !vertex.bsdf.isSpecular && samplesLights &&
    light.choose(p, vertex.lightNormal, choice) && light.samplePoint(p, sampler.x, sampler.y)

  /** Adds the light sample. Weight: light sampling against scattering, whose density is that of the
    * local direction to the light.
    */
  inline def addLight(inline scatterPdf: Vec3 => Float): Unit =
    val localWi = vertex.at.frame.toLocal(light.wi)
    val f = vertex.received(light.wi, localWi)
    if !f.isBlack && reaches() then
      add(arriving(scatterPdf(localWi)) * f * Math.abs(localWi.z))

  /** Adds light of the sampled light. */
  private def add(found: Rgb): Unit =
    radiance.add(found)
    if parts != null then parts.addLight(light.index, depth, found)

  private def reaches(): Boolean =
    val at = vertex.at
    val beyond = media.beyond(at, light.wi, medium)
    visibility.reaches(at.offsetOrigin(light.wi), light.sample, beyond)

  /** What arrives of the light sample, over its density, times the path's throughput and the weight
    * of multiple importance sampling.
    *
    * @param scatterPdf solid-angle density with which the path would scatter to the light
    */
  private def arriving(scatterPdf: Float): Rgb =
    val w = weights
    val s = work.shadow
    val byLight = light.pdf * (w.ur * s.lr + w.ug * s.lg + w.ub * s.lb) * (1f / 3f)
    val byScattering =
      if light.isDelta then 0f
      else scatterPdf * (w.ur * s.ur + w.ug * s.ug + w.ub * s.ub) * (1f / 3f)
    if !(byLight > 0f) then Rgb.Black
    else
      val weight = LightTransport.powerHeuristic(byLight, byScattering) / byLight
      w.throughput * s.throughput * light.sample.radiance.toRgb * weight

  /** As [[Walk.scatterPdf]]. */
  def scatterPdf(localWi: Vec3): Float = vertex.localPdf(localWi)

  /** Samples the BSDF: `vertex.bounce`. */
  def scatter(sampler: Sampler): Unit =
    vertex.draw(sampler)
    weights.scale(vertex.bounce.weight)

  /** As [[Walk.beneath]]. */
  def beneath: Bssrdf | Null = if probe == null || isAbsorbed then null else vertex.beneath

  /** As [[Walk.emerge]]. */
  def emerge(inside: Bssrdf, sampler: Sampler): Boolean =
    val finder = probe
    if finder == null then false
    else
      weights.scale(finder.enter(vertex.at, inside, ray.time, sampler, vertex.at))
      if !isAbsorbed then
        vertex.scatterBy(inside.entry, vertex.at.frame.n)
        isSpread = regularizes
      !isAbsorbed

  /** Leaves in the sampled direction, or ends. */
  def leave(): Unit =
    val bounce = vertex.bounce
    isSpread ||= regularizes && !bounce.isSpecular
    weights.turn(if bounce.isSpecular || !options.samplesLights then 0f else bounce.pdf)
    lastP.set(vertex.at.p)
    lastN.set(vertex.lightNormal)
    etaScale *= square(bounce.eta)
    medium = media.beyond(vertex.at, vertex.at.frame.toWorld(bounce.wi), medium)
    val isOpen = vertex.leave(ray)
    goesOn = isOpen && !isAbsorbed

  /** Russian roulette. */
  def roulette(threshold: Float, sampler: Sampler): Unit =
    val q = weights.brightest * etaScale
    if q < threshold then weights.gamble(sampler.next1D(), q)
    goesOn = !isAbsorbed

object VolumeWalk:
  /** As [[Walk.State]]. */
  private[integrators] final class State:
    val weights: PathWeights = PathWeights()
    var depth, medium = 0
    var etaScale = 0f
    var isSpread = false
    val from: Departure = Departure()
