package candela.integrators

import candela.aov.LightParts
import candela.bsdf.PhaseLobe
import candela.color.Rgb
import candela.guiding.Guide
import candela.lights.{EnvironmentLight, SurfaceLight}
import candela.math.*
import candela.media.{MediumWork, SceneMedia}
import candela.sampling.Sampler
import candela.scene.Scene

/** What some scenes add to the steps of a path: guiding, techniques for caustics, light beneath
  * surfaces, dispersion, regularisation, hidden emitters, pbrt-v2's volumes, and light divided into
  * parts. Mutable, one per path tracer.
  */
private final class PathTechniques(
    tracer: CameraPath,
    scene: Scene,
    options: PathOptions,
    seesThrough: Boolean,
    guide: Guide | Null,
    parts: LightParts | Null,
    volumes: VolumeMarch | Null,
    within: Option[(SceneMedia, MediumWork)]
) extends PathExtension:
  import tracer.{connection, hit, path, vertex}
  private val history = PathHistory(path)
  private val guiding: GuidedScattering | Null =
    if guide == null then null else GuidedScattering(guide, tracer, history)
  private val weights: CausticWeights | Null = options.caustics.orNull
  private val photons: PhotonLight | Null = options.photons.orNull
  private val probe: SubsurfaceProbe | Null =
    if options.subsurface then SubsurfaceProbe(scene) else null

  private val segment: MediumSegment | Null =
    within.map((media, work) => MediumSegment(media, work)).orNull

  /** Phase functions as the BSDFs of guided vertices. */
  private val lobes: Array[PhaseLobe] = within.fold(Array.empty[PhaseLobe])(_._1.lobes)

  /** Where the camera ray began. */
  private val eye = MutableVec3()

  /** Does light sampling alone find light straight through the surface? */
  private var isBoundary = false

  override def startPath(sampler: Sampler): Unit =
    if parts != null then parts.clear()
    history.start()
    eye.set(tracer.ray.origin)
    if volumes != null then volumes.start(tracer.ray, sampler)
    if guiding != null then guiding.startPath(tracer.ray)

  override def travel(sampler: Sampler): Unit =
    val march = volumes
    if march != null then
      if path.depth == 0 then
        march.march(tracer.ray, sampler, parts)
        tracer.L.add(path.throughput * march.added)
        path.scale(march.transmitted)
      else path.scale(march.transmittance(tracer.ray, VolumeMarch.StepsToLights))

  override def gatherInMedium(medium: Int): Boolean =
    val ofRay = segment
    photons != null && ofRay != null && {
      ofRay.start(tracer.ray, medium)
      photons.scatter(ofRay, history)
      tracer.L.add(path.carried(ofRay.radiance.toRgb))
      if photons.bringsAll then
        ofRay.goTo(tracer.ray.tMax): Unit
        ofRay.attenuate()
      photons.bringsAll
    }

  override def emissionFactor(index: Int, light: EnvironmentLight): Float =
    if isLeftOut(index) || hidesEmission then 0f
    else if weights == null || history.casterRatio == 0.0 then 1f
    else weights.ofEmission(index, light.pdf(path.lastP, tracer.ray.direction), history)

  override def emissionFactor(index: Int, light: SurfaceLight): Float =
    if isLeftOut(index) || hidesEmission then 0f
    else if weights == null || light.isShownOnly || history.casterRatio == 0.0 then 1f
    else weights.ofEmission(index, light.pdf(path.lastP, vertex.point), history)

  /** Is what the path meets of the emitter left to photons? */
  private def isLeftOut(light: Int): Boolean =
    photons != null && photons.covers(light, history)

  private def hidesEmission = options.hidesEmitters && path.depth == 0

  override def isHidden: Boolean = hidesEmission && vertex.point.areaLight >= 0

  override def meetEnvironment(light: Int, Le: Rgb): Unit =
    if parts != null && !hidesEmission then
      parts.addEnvironment(light, path.depth, path.carried(Le))

  override def meetSurface(light: Int, Le: Rgb, weight: Float): Unit =
    if parts != null then parts.addLight(light, path.depth, path.carried(Le, weight))

  override def meetMedia(sum: Rgb): Unit =
    if parts != null then parts.addGlowUpTo(path.depth, sum)

  override def arrive(isGuided: Boolean): Unit =
    if history.anyNonSpecularBounces && options.regularizes then
      vertex.scatterBy(vertex.bsdf.regularized)
    // A dispersive BSDF ends the companions of the hero wavelength
    if scene.isDispersive && !path.isAlone && vertex.bsdf.isDispersive then
      path.terminateSecondary()
    if weights != null then weights.arrive(eye, vertex, history)
    if guiding != null then if isGuided then guiding.arrive() else guiding.skipVertex()
    isBoundary = seesThrough && scene.isSubsurface(vertex.point.material)

  override def arriveInMedium(p: Vec3, wo: Vec3, medium: Int): Unit =
    if guiding != null then
      vertex.scatterAt(p, wo, lobes(medium))
      guiding.arrive()
    if weights != null then weights.arriveInMedium(eye, p, history)
    isBoundary = false

  override def takesLightSample: Boolean =
    photons == null || !photons.covers(connection.index, vertex, tracer.ray, hit, history)

  override def directionPdf(localWi: Vec3, pdf: Float): Float =
    if isBoundary && vertex.crosses(localWi) then 0f
    else if guiding == null then pdf
    else guiding.pdf(localWi, connection.wi, pdf)

  override def sampleFactor(localWi: Vec3): Float =
    if weights == null || history.densityRatio == 0.0 || path.depth == 1 then 1f
    else weights.ofSample(connection, vertex, localWi, tracer.ray, hit, history)

  override def recordSample(): Unit =
    if parts != null then parts.addLight(connection.index, path.depth, connection.arrived.toRgb)

  override def addCaustics(): Unit =
    if photons != null then tracer.L.add(path.carried(photons.reflected(vertex, history)))

  override def sampleDirectionInstead(sampler: Sampler): Boolean =
    guiding != null && {
      guiding.scatter(sampler)
      true
    }

  override def moveToExit(sampler: Sampler): Boolean =
    val inside = if probe == null || path.isBlack then null else vertex.beneath
    inside != null && probe != null && {
      if guiding != null then guiding.skipVertex()
      path.scale(probe.enter(vertex.point, inside, tracer.ray.time, sampler, vertex.point))
      if !path.isBlack then
        vertex.scatterBy(inside.entry, vertex.point.frame.n)
        history.emerge()
        isBoundary = false
      !path.isBlack
    }

  override def leaveVertex(): Unit =
    val bounce = vertex.bounce
    history.anyNonSpecularBounces ||= !bounce.isSpecular
    if weights != null then
      val wi = vertex.point.frame.toWorld(bounce.wi.toVec3)
      weights.leaveVertex(vertex, tracer.ray, hit, wi, history)
    if photons != null then photons.leaveVertex(vertex, tracer.ray, hit, history)

  override def leaveInMedium(pdf: Float): Unit =
    history.anyNonSpecularBounces = true
    if weights != null then weights.scatterInMedium(pdf, history)
    if photons != null then photons.leaveMedium(history)

  override def rouletteThroughput(rrBeta: Float): Float =
    if guiding == null then rrBeta else guiding.rouletteThroughput(rrBeta)

  override def nextBranch(sampler: Sampler): Boolean =
    guiding != null && guiding.followNext(sampler)

  override def lightParts: LightParts | Null = parts

  override def raysTraced: Long =
    (if probe == null then 0L else probe.raysTraced) +
      (if volumes == null then 0L else volumes.raysTraced)

private object PathTechniques:
  /** The extension of a path tracer that has these options.
    *
    * @param seesThrough         as in [[PathLimits]]
    * @param guide,parts,volumes as in [[PathTracer$]]
    */
  def of(
      scene: Scene,
      options: PathOptions,
      seesThrough: Boolean,
      guide: Guide | Null,
      sharedParts: LightParts | Null,
      volumes: VolumeMarch | Null = null,
      within: Option[(SceneMedia, MediumWork)] = None
  ): CameraPath => PathExtension =
    val lightParts =
      if sharedParts != null then sharedParts else scene.lightGroups.map(LightParts(_)).orNull
    val isPlain = guide == null && lightParts == null && volumes == null && !options.extendsPaths &&
      !scene.isDispersive && !(seesThrough && scene.hasSubsurface)
    if isPlain then _ => PathExtension()
    else PathTechniques(_, scene, options, seesThrough, guide, lightParts, volumes, within)
