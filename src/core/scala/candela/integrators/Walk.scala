package candela.integrators

import candela.bsdf.Bssrdf
import candela.color.{MutableRgb, Rgb}
import candela.film.LightParts
import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** Which optional steps a path takes.
  *
  * @param regularizes   roughen BSDFs after the first non-specular bounce
  * @param subsurface    does light travel beneath surfaces?
  * @param samplesLights does light sampling look for lights, too?
  * @param crossesPanes  do paths and light samples through media pass panes without a scattering
  *   event, as they pass interfaces?
  * @param hidesLamps    does the camera see through lamps, and no sky?
  * @param interfaces    what interfaces are to light sampling
  * @param countsPassed  is passing an interface one of the events that a path may have?
  */
final case class WalkOptions(
    regularizes: Boolean = false,
    subsurface: Boolean = false,
    samplesLights: Boolean = true,
    crossesPanes: Boolean = false,
    hidesLamps: Boolean = false,
    interfaces: Interfaces = Interfaces.Open,
    countsPassed: Boolean = false
)

/** A path from the camera over surfaces: its state, and the steps of which integrators are made.
  * Mutable, one per worker. Each step that adds light multiplies it by the throughput.
  *
  * @param volumes pbrt-v2's volumes between surfaces, if any
  * @param steps   their step size towards lights, in units of that towards the camera
  * @param sharedParts where to divide the light, if another walk does it there, too
  */
class Walk(
    scene: Scene,
    volumes: VolumeMarch | Null = null,
    steps: Float = VolumeMarch.StepsToLights,
    options: WalkOptions = WalkOptions(),
    sharedParts: LightParts | Null = null
) extends CameraPath:
  /** Light found so far. */
  final val radiance: MutableRgb = MutableRgb()

  /** Product of f·|cos|/pdf, and of what volumes let through. */
  final val throughput: MutableRgb = MutableRgb()

  /** Scattering events so far. */
  var depth: Int = 0

  /** Product of squared relative indices of refraction: throughput · etaScale is free of radiance
    * scaling, so Russian roulette sees the energy.
    */
  var etaScale: Float = 1f

  /** Interfaces passed so far, if they count. */
  var passed: Int = 0

  /** Solid-angle density of the current direction; 0 if light sampling did not compete with it;
    * negative if what it finds is lost.
    */
  var directionPdf: Float = 0f

  /** Has the path bounced off a non-specular surface? Followed only if paths are regularized. */
  var isSpread: Boolean = false

  var goesOn: Boolean = false

  /** Where the path is. */
  final val vertex: SurfaceVertex = SurfaceVertex(scene)

  /** Next-event estimation from there. */
  final val light: LightConnection =
    LightConnection(scene, volumes, steps, crosses = !options.interfaces.stopsLight)

  // Where the current direction was sampled
  private val lastP, lastN = MutableVec3()

  private var ray = Ray()
  private val hit = Hit()
  private var rays = 0L
  private val regularizes = options.regularizes
  private val samplesLights = options.samplesLights
  private val hidesLamps = options.hidesLamps
  private val interfaces = options.interfaces
  private val countsPassed = options.countsPassed
  private val disperses = scene.isDispersive

  /** The light found so far, divided, if the scene asks for it. */
  val parts: LightParts | Null =
    if sharedParts != null then sharedParts else scene.lightGroups.map(LightParts(_)).orNull

  /** Does the path carry its hero wavelength only? */
  private var isAlone = false
  private val probe: SubsurfaceProbe | Null =
    if options.subsurface then SubsurfaceProbe(scene) else null

  def raysTraced: Long =
    val march = volumes
    val beneath = probe
    rays + light.raysTraced + (if march == null then 0L else march.raysTraced) +
      (if beneath == null then 0L else beneath.raysTraced)

  /** Starts a path along a camera ray, which the walk overwrites. */
  def begin(cameraRay: Ray, sampler: Sampler): Unit =
    ray = cameraRay
    radiance.set(Rgb.Black)
    if parts != null then parts.clear()
    throughput.set(Rgb.White)
    depth = 0
    passed = 0
    etaScale = 1f
    directionPdf = 0f
    isSpread = false
    goesOn = true
    light.begin(ray.time)
    isAlone = false
    val march = volumes
    if march != null then march.start(ray, sampler)

  def end(): Unit = goesOn = false

  /** Keeps the path as it is, to follow it again from here. */
  protected final def keep(to: Walk.State): Unit =
    to.throughput.set(throughput.toRgb)
    to.depth = depth
    to.passed = passed
    to.etaScale = etaScale
    to.directionPdf = directionPdf
    to.isSpread = isSpread
    to.isAlone = isAlone
    to.from.set(lastP, lastN, ray)

  /** Goes on with the path as it was; the light found stays. */
  protected final def goOn(from: Walk.State): Unit =
    throughput.set(from.throughput.toRgb)
    depth = from.depth
    passed = from.passed
    etaScale = from.etaScale
    directionPdf = from.directionPdf
    isSpread = from.isSpread
    isAlone = from.isAlone
    from.from.restore(lastP, lastN, ray)
    goesOn = true

  /** Traces the ray to the next vertex; false if it leaves the scene. */
  def intersect(): Boolean =
    rays += 1
    val found = scene.closest(ray, hit)
    if found then vertex.hit(ray, hit)
    found

  /** Adds what volumes emit and scatter along the ray just traced, and attenuates the path. */
  def marchThroughVolumes(sampler: Sampler): Unit =
    val march = volumes
    if march != null then
      march.march(ray, sampler, parts)
      radiance.addProduct(throughput, march.added)
      throughput.scale(march.transmitted)

  /** Attenuates the path along the ray just traced. */
  def attenuateByVolumes(): Unit =
    val march = volumes
    if march != null then throughput.scale(march.transmittance(ray, steps))

  /** Adds the environment's radiance and ends the path. Weight: BSDF sampling against light
    * sampling.
    */
  def addEnvironment(): Unit =
    if !hidesLamps || depth > 0 then
      val found = LightTransport.environment(
        scene,
        ray,
        (i, source) => emissionWeight(i, source.pdf(lastP, ray.direction)),
        (i, light) => if parts != null then parts.addEnvironment(i, depth, throughput.toRgb * light)
      )
      radiance.addProduct(throughput, found)
    end()

  /** Adds what the surface emits. Weight: BSDF sampling against light sampling. */
  def addEmission(): Unit =
    val at = vertex.at
    if at.areaLight >= 0 && !isHidden then
      val source = scene.surfaceLight(at)
      val emitted = source.radiance(at, vertex.wo)
      if !emitted.isBlack then
        val weight =
          if source.isShownOnly then shownWeight
          else emissionWeight(at.areaLight, source.pdf(lastP, at))
        val found = throughput.toRgb * emitted * weight
        radiance.add(found)
        if parts != null then parts.addLight(at.areaLight, depth, found)

  /** Of light that only the camera and specular scattering see. */
  private def shownWeight: Float = if directionPdf != 0f then 0f else 1f

  /** @param pointPdf solid-angle density with which light sampling finds the point of the light */
  private inline def emissionWeight(light: Int, inline pointPdf: Float): Float =
    if directionPdf > 0f then
      val chosen = scene.selection.probability(lastP, lastN, light)
      LightTransport.powerHeuristic(directionPdf, chosen * pointPdf)
    else if directionPdf == 0f then 1f
    else 0f

  /** Does the path go on behind the surface as if it weren't there? */
  final def isPassed: Boolean = isAtInterface || isHidden

  /** Does light pass here unscattered? */
  final def isAtInterface: Boolean = scene.isPassed(ray, hit, vertex.at)

  private def isHidden = hidesLamps && depth == 0 && vertex.at.areaLight >= 0

  /** Has the path had as many events? */
  final def hasHad(most: Int): Boolean = depth + passed == most

  /** Continues through an interface or a hidden lamp, unless the path has had `most` events that
    * count.
    */
  def passThrough(most: Int = Int.MaxValue): Unit =
    if countsPassed && !isHidden then if hasHad(most) then end() else passed += 1
    if directionPdf > 0f then
      interfaces match
        case Interfaces.Closed => directionPdf = 0f
        case Interfaces.Lossy => directionPdf = Walk.Lost
        case _ => ()
    vertex.passThrough(ray)

  /** Evaluates the BSDF of the vertex: a scattering event. A dispersive one ends the companions of
    * the hero wavelength.
    */
  def evaluate(): Unit =
    depth += 1
    vertex.evaluate(isSpread)
    if disperses && !isAlone && vertex.bsdf.isDispersive then keepHero()

  /** Goes on with the hero wavelength only, in place of all three. */
  def keepHero(): Unit =
    isAlone = true
    throughput.scale(LightTransport.Hero)

  /** Chooses one light and samples a point on it; false if it contributes nothing. Takes no random
    * numbers where the BSDF is specular or the scene has no lights.
    */
  def sampleOneLight(sampler: Sampler): Boolean =
    if !samplesLights || vertex.bsdf.isSpecular || scene.lights.length == 0 then false
    else
      val choice = sampler.next1D(matters = light.isRandom)
      sampler.next2D()
      val p = vertex.at.p
      light.choose(p, vertex.lightNormal, choice) && light.samplePoint(p, sampler.x, sampler.y)

  /** Adds the light sample. Weight: light sampling against BSDF sampling, as given. */
  inline def addLight(inline weight: Vec3 => Float): Unit =
    val found = light.scattered(vertex, weight)
    radiance.addProduct(throughput, found)
    if parts != null then parts.addLight(light.index, depth, throughput.toRgb * found)

  /** Solid-angle density with which [[scatter]] takes the local direction of the light sample. */
  def scatterPdf(localWi: Vec3): Float = vertex.localPdf(localWi)

  /** Adds light that leaves the vertex towards the path. */
  def add(light: Rgb): Unit = radiance.addProduct(throughput, light)

  /** Samples the BSDF: `vertex.bounce`. */
  def scatter(sampler: Sampler): Unit =
    vertex.draw(sampler)
    throughput.scale(vertex.bounce.weight)

  /** Samples a direction in place of the BSDF: `vertex.bounce`.
    *
    * @param bothSides of the surface, with equal density; else of the side where the path came from
    */
  def scatterUniformly(bothSides: Boolean, sampler: Sampler): Unit =
    vertex.drawUniformly(bothSides, sampler)
    throughput.scale(vertex.bounce.weight)

  /** How light travels beneath the surface that the path was just refracted into; null: it goes
    * straight on.
    */
  def beneath: Bssrdf | Null =
    if probe == null || throughput.isBlack then null else vertex.beneath

  /** Lets the path emerge elsewhere on the surface, as part of the same scattering event; false if
    * it doesn't.
    */
  def emerge(inside: Bssrdf, sampler: Sampler): Boolean =
    val finder = probe
    if finder == null then false
    else
      throughput.scale(finder.enter(vertex.at, inside, ray.time, sampler, vertex.at))
      val emerges = !throughput.isBlack
      if emerges then
        vertex.scatterBy(inside.entry, vertex.at.frame.n)
        isSpread = regularizes
      emerges

  /** Leaves in the sampled direction, or ends. */
  def leave(): Unit =
    val bounce = vertex.bounce
    isSpread ||= regularizes && !bounce.isSpecular
    directionPdf = if bounce.isSpecular || !samplesLights then 0f else bounce.pdf
    lastP.set(vertex.at.p)
    lastN.set(vertex.lightNormal)
    etaScale *= square(bounce.eta)
    val isOpen = vertex.leave(ray)
    goesOn = isOpen && !throughput.isBlack

  /** Samples a specular direction and leaves in it, or ends. */
  def leaveSpecularly(sampler: Sampler): Unit =
    val sample = vertex.bsdf.sampleSpecular(vertex.localWo, sampler.next1D())
    throughput.scale(sample.weight)
    goesOn = !throughput.isBlack
    vertex.leave(ray, sample.wi, sample.isSpecular, sample.eta): Unit

  /** Russian roulette. */
  def roulette(threshold: Float, sampler: Sampler): Unit =
    throughput.scale(
      LightTransport.roulette(throughput.largest * etaScale, threshold, sampler)
    )
    goesOn = !throughput.isBlack

object Walk:
  /** The density of directions in which light is lost. */
  private inline val Lost = -1f

  /** What a walk keeps of a path that it will follow later. Mutable. */
  private[integrators] final class State:
    val throughput: MutableRgb = MutableRgb()
    var depth, passed = 0
    var etaScale, directionPdf = 0f
    var isSpread, isAlone = false
    val from: Departure = Departure()
