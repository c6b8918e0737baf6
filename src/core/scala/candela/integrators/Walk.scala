package candela.integrators

import candela.aov.LightParts
import candela.bsdf.Bssrdf
import candela.color.{MutableRgb, Rgb}
import candela.geometry.{Hit, Ray}
import candela.guiding.Guide
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** A path from the camera, and the steps of which integrators are made. [[PathState]] says why its
  * estimate is unbiased. Mutable, one per worker.
  *
  * At each vertex: [[trace]] and [[travel]] get there; [[addEnvironment]], or [[meetSurface]] and
  * [[addEmission]], add what the ray has met; [[evaluate]] prepares the vertex; [[sampleLight]] and
  * [[connect]] add light of an emitter; [[scatter]] samples the next direction, and [[leave]] takes
  * it; [[roulette]] may end the path. [[StepOrder]] checks the order.
  *
  * [[SurfaceWalk]] and [[VolumeWalk]] say what is between surfaces, and how light samples get to a
  * vertex. Few programs load both, so the JIT compiler knows which of them is meant.
  *
  * @param path        what the path carries
  * @param connection  samples lights
  * @param guide       null: directions are sampled from BSDFs and phase functions alone
  * @param sharedParts where to divide the light, if another walk does it there, too
  */
abstract class Walk(
    scene: Scene,
    options: WalkOptions,
    final val path: PathState,
    final val connection: LightConnection,
    guide: Guide | Null,
    sharedParts: LightParts | Null
):
  /** Where the path is. */
  final val vertex: SurfaceVertex = SurfaceVertex(scene)

  /** The light found so far, divided; null: the scene doesn't ask for it. */
  final val parts: LightParts | Null =
    if sharedParts != null then sharedParts else scene.lightGroups.map(LightParts(_)).orNull

  protected final val found: MutableRgb = MutableRgb()
  protected final val order: StepOrder = StepOrder()

  /** The direction of the path, and what it has met there. */
  protected final var ray: Ray = Ray()
  protected final val hit: Hit = Hit()

  protected final val guiding: GuidedScattering | Null =
    if guide == null then null else GuidedScattering(guide, this, options.aim.orNull)
  protected final val samplesLights: Boolean = options.samplesLights
  protected final val regularizes: Boolean = options.regularizes
  private val hidesEmitters = options.hidesEmitters
  private val countsPassed = options.countsPassed
  protected final val caustics: CausticWeights | Null = options.caustics.orNull

  /** Where the camera ray began; known if caustics are. */
  protected final val eye = MutableVec3()
  private val manifolds: Manifolds | Null = options.manifolds.orNull
  private val chains: ManifoldLighting | Null =
    if manifolds == null then null else ManifoldLighting(scene, manifolds)
  protected final val photons: PhotonLight | Null = options.photons.orNull
  private val disperses = scene.isDispersive
  private val hasLights = scene.lights.length > 0
  private val probe: SubsurfaceProbe | Null =
    if options.subsurface then SubsurfaceProbe(scene) else null
  private var rays = 0L
  private var isFollowed = false

  /** Has the path not ended yet? */
  final def goesOn: Boolean = isFollowed

  /** Scattering events so far. */
  final def depth: Int = path.depth

  /** All light found. */
  def radiance: Rgb = found.toRgb

  final def raysTraced: Long =
    val beneath = probe
    rays + otherRays + (if beneath == null then 0L else beneath.raysTraced) +
      (if chains == null then 0L else chains.raysTraced)

  /** Rays of light samples, and of what is between surfaces. */
  protected def otherRays: Long

  /** Starts a path along a camera ray, which the walk overwrites. */
  final def begin(cameraRay: Ray, sampler: Sampler): Unit =
    order.set(Stage.Departed)
    ray = cameraRay
    found.set(Rgb.Black)
    if parts != null then parts.clear()
    path.start()
    if caustics != null then eye.set(ray.origin)
    start(sampler)
    if guiding != null then guiding.begin(ray)
    isFollowed = true

  /** Starts what is between surfaces. */
  protected def start(sampler: Sampler): Unit

  final def end(): Unit =
    order.set(Stage.Ended)
    isFollowed = false

  /** Goes on where the path has just been sent, unless it carries nothing. */
  protected final def goOn(): Unit = isFollowed = !path.isDead

  /** Traces the ray to the next surface; false if it leaves the scene. */
  final def trace(): Boolean =
    rays += 1
    val isHit = scene.closest(ray, hit)
    order.step(to = if isHit then Stage.Hit else Stage.Escaped, Stage.Departed)
    isHit

  /** Goes along the ray just traced through what is between surfaces, which attenuates the path,
    * may add light to it, and may scatter it.
    *
    * @return does the path come to the end of the ray? Else it was scattered before, or has ended
    */
  def travel(limits: PathLimits, sampler: Sampler): Boolean

  /** Computes the vertex where the ray has met a surface. */
  final def meetSurface(): Unit =
    order.step(to = Stage.Arrived, Stage.Hit)
    vertex.hit(ray, hit)

  /** Adds the environment's radiance and ends the path. */
  final def addEnvironment(): Unit =
    order.step(to = Stage.Ended, Stage.Escaped)
    if !hidesEmitters || depth > 0 then
      val weighted = LightTransport.environment(
        scene,
        ray,
        weight = (i, source) =>
          if isLeft(i) then 0f
          else
            val d = ray.direction
            emissionWeight(
              i,
              source.pdf(path.lastP, d),
              source.emissionPdf(scene.ball, path.lastP, Vec3.Zero, -d)
            )
        ,
        found = (i, arriving) =>
          if parts != null then parts.addEnvironment(i, depth, path.carried(arriving, 1f))
      )
      path.addTo(found, weighted, 1f)
      if guiding != null && !path.competes then guiding.meet(path.carried(weighted, 1f).average)
    end()

  /** Adds what the surface emits. */
  final def addEmission(): Unit =
    order.step(to = Stage.Arrived, Stage.Arrived)
    val point = vertex.at
    if point.areaLight >= 0 && !isHidden then
      val source = scene.surfaceLight(point)
      val emitted = source.radiance(point, vertex.wo)
      if !emitted.isBlack && !isLeft(point.areaLight) then
        val weight =
          // Only the camera and specular scattering see it
          if source.isShownOnly then (if path.competes then 0f else 1f)
          else
            emissionWeight(
              point.areaLight,
              source.pdf(path.lastP, point),
              source.emissionPdf(scene.ball, point.p, point.geometricNormal, vertex.wo) /
                vertex.cosine(vertex.wo)
            )
        path.addTo(found, emitted, weight)
        if guiding != null && !path.competes then
          guiding.meet(path.carried(emitted, weight).average)
        if parts != null then parts.addLight(point.areaLight, depth, path.carried(emitted, weight))

  /** Is what the path meets of the emitter left to manifold walks or photons? */
  private def isLeft(light: Int): Boolean =
    (manifolds != null && manifolds.finds(light, path)) ||
      (photons != null && photons.brings(light, path))

  /** Weight of light that the path meets against light sampling.
    *
    * @param pointPdf solid-angle density with which light sampling finds the point of the light
    * @param emitted  as for [[CausticWeights.ofEmission]]
    */
  private inline def emissionWeight(
      lightIndex: Int,
      inline pointPdf: Float,
      inline emitted: Float
  ): Float =
    val weight =
      if path.competes then
        val choice = scene.selection.probability(path.lastP, path.lastN, lightIndex)
        path.emissionWeight(choice, pointPdf)
      else 1f
    val rivals = caustics
    if rivals == null || !rivals.competes(path) then weight
    else weight * rivals.ofEmission(lightIndex, pointPdf, emitted, path)

  /** Does the path go on behind the surface as if it weren't there? */
  final def isPassed: Boolean = isAtInterface || isHidden

  /** Does light pass here unscattered? */
  final def isAtInterface: Boolean = scene.isPassed(ray, hit, vertex.at)

  private def isHidden = hidesEmitters && depth == 0 && vertex.at.areaLight >= 0

  /** Has the path had as many events? */
  final def hasHad(most: Int): Boolean = depth + path.passed == most

  /** Continues through an interface or a hidden emitter, unless the path has had `most` events that
    * count.
    */
  final def passThrough(most: Int = Int.MaxValue): Unit =
    order.step(to = Stage.Departed, Stage.Arrived)
    if countsPassed && !isHidden then if hasHad(most) then end() else path.passed += 1
    keepDirection()

  private def keepDirection(): Unit =
    vertex.passThrough(ray)
    afterPassing()

  /** The path has passed the surface of the vertex unscattered. */
  protected def afterPassing(): Unit

  /** Is the surface a pane that the path may cross? */
  def isAtPane: Boolean = false

  /** Continues through a pane, as through an interface and without an event, or is scattered. */
  final def crossPane(sampler: Sampler): Unit =
    scatter(sampler)
    if vertex.isStraight then
      order.step(to = Stage.Departed, Stage.Scattered)
      path.depth -= 1
      keepDirection()
      goOn()
    else leave()

  /** Evaluates the BSDF of the vertex: a scattering event. A dispersive one ends the companions of
    * the hero wavelength.
    *
    * @param isGuided may the direction be guided?
    */
  final def evaluate(isGuided: Boolean = true): Unit =
    order.step(to = Stage.Evaluated, Stage.Arrived)
    path.depth += 1
    vertex.evaluate(path.isSpread)
    if disperses && !path.isAlone && vertex.bsdf.isDispersive then path.keepHero()
    val rivals = caustics
    if rivals != null then rivals.arrive(eye, vertex, path)
    if chains != null then chains.arrive()
    if guiding != null then if isGuided then guiding.arrive() else guiding.leaveAlone()

  /** Chooses one light and samples a point on it; false if it contributes nothing. */
  final def sampleLight(sampler: Sampler): Boolean =
    order.step(to = Stage.Evaluated, Stage.Evaluated)
    val isSampled = samplesLights && hasLights && !vertex.bsdf.isSpecular
    if !isSampled && !drawsAlways then false
    else
      val choice = sampler.next1D(matters = connection.isRandom)
      sampler.next2D()
      val p = vertex.at.p
      val isLit = isSampled && connection.choose(p, vertex.lightNormal, choice) &&
        connection.samplePoint(p, sampler.x, sampler.y) &&
        (photons == null || !photons.brings(connection.index, vertex, ray, hit, path))
      if isLit then order.step(to = Stage.Sampled, Stage.Evaluated)
      isLit

  /** Adds light that manifold walks find, or photons bring. */
  final def addCaustics(sampler: Sampler): Unit =
    val map = photons
    if map != null then path.addTo(found, map.reflected(vertex, path), 1f)
    val finder = chains
    if finder != null && manifolds != null && manifolds.suits(vertex, path) &&
      finder.finds(vertex, path, ray.time, sampler)
    then
      val arrived = finder.arrived.toRgb
      path.addTo(found, arrived, 1f)
      if parts != null then parts.addLight(finder.index, depth, path.carried(arrived, 1f))

  /** Are the random numbers of light sampling drawn at surfaces where it finds nothing, too? Then
    * later ones have the same dimension whatever the path has met.
    */
  protected def drawsAlways: Boolean

  /** Adds the light sample, if it is visible. Weight: light sampling against the density with which
    * the path takes that direction.
    *
    * @param isBoundary does light sampling alone find light straight through the surface?
    */
  def connect(isBoundary: Boolean): Unit

  /** Solid-angle density with which the path itself finds what is in the direction of the light
    * sample, which is local to a surface.
    */
  protected final def competingPdf(localWi: Vec3, isBoundary: Boolean): Float =
    if isBoundary && vertex.crosses(localWi) then 0f
    else takenPdf(localWi, vertex.localPdf(localWi))

  /** Likewise, if the BSDF or phase function has the density `pdf`. */
  protected final def takenPdf(localWi: Vec3, pdf: Float): Float =
    if guiding == null then pdf else guiding.pdf(localWi, connection.wi, pdf)

  /** Samples the next direction: `vertex.bounce`. */
  final def scatter(sampler: Sampler): Unit =
    order.step(to = Stage.Scattered, Stage.Evaluated, Stage.Sampled)
    if guiding != null then guiding.scatter(sampler)
    else
      vertex.draw(sampler)
      path.scale(vertex.bounce.weight)

  /** How light travels beneath the surface that the path was just refracted into; null: it goes
    * straight on.
    */
  final def beneath: Bssrdf | Null =
    if probe == null || path.isDead then null else vertex.beneath

  /** Lets the path emerge elsewhere on the surface, as part of the same scattering event; false if
    * it doesn't.
    */
  final def emerge(inside: Bssrdf, sampler: Sampler): Boolean =
    val finder = probe
    if finder == null then false
    else
      if guiding != null then guiding.leaveAlone()
      path.scale(finder.enter(vertex.at, inside, ray.time, sampler, vertex.at))
      val emerges = !path.isDead
      if emerges then
        order.step(to = Stage.Evaluated, Stage.Scattered)
        vertex.scatterBy(inside.entry, vertex.at.frame.n)
        path.isSpread = regularizes
        path.rival = 0.0
        path.chain = Manifolds.NoWalks
      emerges

  /** Leaves in the sampled direction, or ends. */
  def leave(): Unit =
    order.step(to = Stage.Departed, Stage.Scattered)
    val bounce = vertex.bounce
    val isUnsampled = bounce.isSpecular || !samplesLights
    path.isSpread ||= regularizes && !bounce.isSpecular
    path.turn(vertex.at.p, vertex.lightNormal, pdf = if isUnsampled then 0f else bounce.pdf)
    path.etaScale *= square(bounce.eta)
    val rivals = caustics
    if rivals != null then
      rivals.leave(vertex, ray, hit, vertex.at.frame.toWorld(bounce.wi.toVec3), path)
    val finder = chains
    if finder != null then finder.leave(vertex, hit, path)
    val map = photons
    if map != null then map.leave(vertex, ray, hit, path)
    val isOpen = vertex.leave(ray)
    afterLeaving()
    if isOpen then goOn() else end()

  /** The path has left a surface. */
  protected def afterLeaving(): Unit

  /** Russian roulette, by the throughput. */
  final def roulette(threshold: Float, sampler: Sampler): Unit =
    order.step(to = Stage.Departed, Stage.Departed)
    val largest = path.largest * path.etaScale
    path.scale(
      if guiding != null then guiding.roulette(largest, threshold, sampler)
      else LightTransport.roulette(largest, threshold, sampler)
    )
    goOn()

  /** Goes on with the next branch of a guided path; false: there is none, all light is found. */
  final def followNext(sampler: Sampler): Boolean = guiding != null && guiding.followNext(sampler)

  /** Keeps the path as it is, to follow it from here again. */
  private[integrators] final def keep(to: Branches.Branch): Unit =
    to.path.set(path)
    to.departure.set(ray)

  /** Goes on with the path as it was; the light found stays. */
  private[integrators] final def restore(from: Branches.Branch, stage: Stage): Unit =
    order.set(stage)
    path.set(from.path)
    from.departure.restore(ray)
    isFollowed = true
