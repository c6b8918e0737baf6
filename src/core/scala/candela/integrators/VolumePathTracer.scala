package candela.integrators

import candela.aov.LightParts
import candela.color.Rgb
import candela.geometry.Ray
import candela.guiding.Guide
import candela.math.*
import candela.media.{MediumWork, SceneMedia}
import candela.sampling.Sampler
import candela.scene.Scene

/** Path tracing through participating media, which scatter the path, and attenuate light samples on
  * their way, also through interfaces. [[PathExtension]] has what only some scenes need.
  *
  * Sources: as [[PathTracer]]; PBRT 4th ed., §14.2.3; [[candela.media.PathWeights]], whose `u` are
  * the book's `r_u`, and `l` its `r_l`. Light samples and the path are combined by the power
  * heuristic, where Miller, Georgiev and Jarosz 2019 use the balance heuristic; the three colours
  * by the balance heuristic. [[PathState]] says why the estimate is unbiased.
  */
final class VolumePathTracer private (
    scene: Scene,
    media: SceneMedia,
    limits: PathLimits,
    options: PathOptions,
    work: MediumWork,
    volumePath: VolumePath,
    lightConnection: LightConnection,
    extend: CameraPath => PathExtension
) extends CameraPath(scene, volumePath, lightConnection, extend):
  import options.samplesLights
  private val crossesPanes = options.crossesPanes && scene.hasPanes
  private val visibility = MediumVisibility(scene, media, work, crossesPanes)

  /** Do photons bring all that media scatter, so that paths go straight through them? */
  private val goesStraight = options.photons.exists(_.bringsAll)
  private val hasLights = samplesLights && scene.lights.length > 0

  override def raysTraced: Long = super.raysTraced + visibility.raysTraced

  override def radianceSoFar: Rgb = L.toRgb + emitted

  /** What media emitted towards the camera. */
  private def emitted: Rgb = Rgb(work.glowR, work.glowG, work.glowB)

  def radiance(cameraRay: Ray, sampler: Sampler): Rgb =
    startPath(cameraRay)
    work.start(hero = if media.isChromatic then (sampler.next1D() * 3f).toInt else 0)
    work.random.seed(sampler.next1D(), sampler.next1D())
    visibility.start(ray.time)
    volumePath.medium = media.camera
    extension.startPath(sampler)
    while goesOn || extension.nextBranch(sampler) do
      // Sample a scattering event before the next surface
      rays += 1
      val isHit = scene.closest(ray, hit)
      val t = if volumePath.medium < 0 then -1f else sampleMedium(sampler)
      if volumePath.isBlack then goesOn = false
      else if t >= 0f then
        if isAtMaxDepth then goesOn = false
        else
          scatterInMedium(t, sampler)
          roulette(volumePath, limits, sampler)
      else if !isHit then
        // Add light of the environment
        val Le = environment()
        L.add(volumePath.carried(Le))
        goesOn = false
      else
        vertex.hit(ray, hit)
        val point = vertex.point
        addEmission((Le, weight) => L.add(volumePath.carried(Le, weight)))
        val isPane = crossesPanes && scene.isPane(point)
        if scene.isPassed(ray, hit, point) || extension.isHidden then skipIntersection()
        else if !isPane && isAtMaxDepth then goesOn = false
        else
          volumePath.depth += 1
          vertex.evaluate()
          extension.arrive(isGuided = !isPane)
          // Scatter, and once more where light emerges from beneath the surface
          var isAtVertex = true
          while isAtVertex do
            // Sample direct light. Random numbers are drawn at all surfaces but panes
            val isSampled = !vertex.bsdf.isSpecular && volumePath.depth <= limits.maxDepth
            if isSampled || !isPane then
              val isLit =
                sampleLight(point.p, vertex.lightNormal, sampler, isUsed = isSampled && hasLights)
              if isLit && extension.takesLightSample then addDirect()
            extension.addCaustics()
            // Sample the BSDF for the next direction
            if !extension.sampleDirectionInstead(sampler) then
              vertex.draw(sampler)
              volumePath.scale(vertex.bounce.weight)
            isAtVertex = extension.moveToExit(sampler)
          // What goes straight through a pane is no scattering event
          if isPane && vertex.isStraight then
            volumePath.depth -= 1
            skipIntersection()
            goesOn = !volumePath.isBlack
          else leaveVertex()
          if volumePath.depth > limits.maxDepth then goesOn = false
          roulette(volumePath, limits, sampler)
    radianceSoFar

  private def isAtMaxDepth: Boolean = volumePath.depth == limits.maxDepth

  /** Samples the next scattering event in the medium before the end of the ray, and weights the
    * path up to there, or to the end.
    *
    * @return the ray's parameter of a scattering event; −1: none
    */
  private def sampleMedium(sampler: Sampler): Float =
    if extension.gatherInMedium(volumePath.medium) then -1f
    else
      // As in pbrt-v4, media emit only while another scattering event may follow. Without light
      // sampling, the last segment counts, too
      val emits = volumePath.depth < limits.maxDepth || !samplesLights
      val t = media(volumePath.medium).follow(ray, sampler.next1D(), emits, work)
      extension.meetMedia(emitted)
      t

  /** A whole scattering event at parameter `t` of the ray. */
  private def scatterInMedium(t: Float, sampler: Sampler): Unit =
    volumePath.depth += 1
    val p = ray.at(t)
    val wo = -ray.direction
    val phase = media(volumePath.medium).phase
    extension.arriveInMedium(p, wo, volumePath.medium)
    if hasLights then
      if sampleLight(p, Vec3.Zero, sampler, isUsed = true) then
        val f = phase.value(wo, connection.wi)
        if visibility.reaches(p, connection.sample, volumePath.medium) then
          // Any local direction: in a medium guiding needs only that in the world
          val arriving = sampled(extension.directionPdf(Vec3.Z, f)) * f
          addSample(arriving)
    if extension.sampleDirectionInstead(sampler) then leaveVertex()
    else
      sampler.next2D()
      // f/p is 1: phase functions are sampled exactly
      val wi = phase.sample(wo, sampler.x, sampler.y)
      val pdf = phase.value(wo, wi)
      extension.leaveInMedium(pdf)
      leaveInMedium(p, wi, pdf)

  override def leaveVertex(): Unit =
    // Guiding samples phase functions as BSDFs of vertices in the medium
    if vertex.isInMedium then
      val bounce = vertex.bounce
      extension.leaveInMedium(vertex.localPdf(bounce.wi))
      leaveInMedium(vertex.point.p, vertex.point.frame.toWorld(bounce.wi), bounce.pdf)
    else
      super.leaveVertex()
      if !samplesLights then volumePath.weights.startSegment(0f)
      volumePath.medium = media.beyond(vertex.point, ray.direction, volumePath.medium)

  /** @param pdf solid-angle density of the direction */
  private def leaveInMedium(p: Vec3, wi: Vec3, pdf: Float): Unit =
    volumePath.startSegment(p, Vec3.Zero, if samplesLights then pdf else 0f)
    ray.set(p, wi, Float.PositiveInfinity)
    ray.differential.isKnown = false
    goesOn = !volumePath.isBlack

  /** Goes on behind the surface. */
  private def skipIntersection(): Unit =
    vertex.passThrough(ray)
    volumePath.medium = media.beyond(vertex.point, ray.direction, volumePath.medium)

  /** Adds the light sample at a surface, if it is visible. */
  private def addDirect(): Unit =
    val wi = connection.wi
    val localWi = vertex.point.frame.toLocal(wi)
    val f = vertex.received(wi, localWi)
    if !f.isBlack then
      val beyond = media.beyond(vertex.point, wi, volumePath.medium)
      if visibility.reaches(vertex.point.offsetOrigin(wi), connection.sample, beyond) then
        val arriving = sampled(extension.directionPdf(localWi, vertex.localPdf(localWi)))
        addSample(arriving * f * (Math.abs(localWi.z) * extension.sampleFactor(localWi)))

  private def addSample(Ld: Rgb): Unit =
    connection.arrived.set(Ld)
    L.add(Ld)
    extension.recordSample()

  /** What arrives of the light sample, over its density, times the path's throughput and the weight
    * of multiple importance sampling. Both densities are in units of the path's own, and averages
    * over the colours, each of which might have sampled this path.
    *
    * @param pdf solid-angle density with which the path takes the direction to the light
    */
  private def sampled(pdf: Float): Rgb =
    val w = volumePath.weights
    val s = work.shadow
    val passing = w.ur * s.lr + w.ug * s.lg + w.ub * s.lb
    val byLight = connection.pdf * passing * (1f / 3f)
    val byPath =
      if connection.isDelta then 0f
      else
        // A path that goes straight passes media as a light sample does
        val unscattered =
          if goesStraight then passing else w.ur * s.ur + w.ug * s.ug + w.ub * s.ub
        pdf * unscattered * (1f / 3f)
    if !(byLight > 0f) then Rgb.Black
    else
      val weight = LightTransport.powerHeuristic(byLight, byPath) / byLight
      w.throughput * s.throughput * connection.sample.radiance.toRgb * weight

object VolumePathTracer:
  /** @param guide,parts as in [[PathTracer$]] */
  def apply(
      scene: Scene,
      media: SceneMedia,
      limits: PathLimits,
      options: PathOptions = PathOptions(),
      guide: Guide | Null = null,
      parts: LightParts | Null = null
  ): VolumePathTracer =
    val work = MediumWork()
    val connection = LightConnection(scene)
    val extend = PathTechniques.of(
      scene,
      options,
      limits.seesThrough,
      guide,
      parts,
      within = Some((media, work))
    )
    // The weights that media change are the path's own
    new VolumePathTracer(
      scene, media, limits, options, work, VolumePath(work.weights), connection, extend
    )
