package candela.integrators

import candela.aov.LightParts
import candela.bsdf.PhaseLobe
import candela.color.Rgb
import candela.guiding.Guide
import candela.math.*
import candela.media.{MediumWork, SceneMedia}
import candela.sampling.{PhaseFunction, Sampler}
import candela.scene.Scene

/** A [[Walk]] through participating media, which scatter the path, and attenuate light samples on
  * their way, also through interfaces. Mutable.
  */
final class VolumeWalk private (
    scene: Scene,
    media: SceneMedia,
    options: WalkOptions,
    work: MediumWork,
    volumePath: VolumePath,
    guide: Guide | Null,
    sharedParts: LightParts | Null
) extends Walk(scene, options, volumePath, LightConnection(scene), guide, sharedParts):
  private val crossesPanes = options.crossesPanes && scene.hasPanes
  private val visibility = MediumVisibility(scene, media, work, crossesPanes)
  private val samplesInMedia = options.samplesLights && scene.lights.length > 0

  /** Photons light it. */
  private val segment = MediumSegment(media, work)

  /** Do photons bring all that media scatter, so that paths go straight through them? */
  private val goesStraight = photons != null && photons.bringsAll

  /** Phase functions as the BSDFs of guided vertices. */
  private val lobes =
    if guide == null then Array.empty[PhaseLobe]
    else media.media.map(medium => PhaseLobe(medium.phase))

  protected def otherRays: Long = visibility.raysTraced

  /** With what media emitted towards the camera. */
  override def radiance: Rgb = super.radiance + glow

  private def glow: Rgb = Rgb(work.glowR, work.glowG, work.glowB)

  protected def start(sampler: Sampler): Unit =
    work.start(hero = if media.isChromatic then (sampler.next1D() * 3f).toInt else 0)
    work.random.seed(sampler.next1D(), sampler.next1D())
    visibility.start(ray.time)
    volumePath.medium = media.camera

  def travel(limits: PathLimits, sampler: Sampler): Boolean =
    val map = photons
    if map == null || volumePath.medium < 0 then travelOrScatter(limits, sampler)
    else
      segment.begin(ray, volumePath.medium)
      map.scatter(segment, path)
      path.addTo(found, segment.found.toRgb, 1f)
      if goesStraight then passStraight() else travelOrScatter(limits, sampler)

  private def passStraight(): Boolean =
    segment.goTo(ray.tMax): Unit
    segment.attenuate()
    if path.isDead then end()
    goesOn

  private def travelOrScatter(limits: PathLimits, sampler: Sampler): Boolean =
    // The last event may be in a medium that shines, if paths find light only where they meet it
    val t = collide(emits = depth < limits.maxDepth || !samplesLights, sampler)
    if path.isDead then
      end()
      false
    else if t >= 0f then
      if hasHad(limits.maxDepth) then end() else scatterAt(t, sampler)
      false
    else true

  /** Samples a collision with the medium before the end of the ray, and attenuates the path up to
    * there.
    *
    * @return the ray's parameter of a scattering event; −1: none
    */
  private def collide(emits: Boolean, sampler: Sampler): Float =
    if volumePath.medium < 0 then -1f
    else
      val t = media.media(volumePath.medium).follow(ray, sampler.next1D(), emits, work)
      if parts != null then parts.addGlowUpTo(depth, glow)
      t

  /** A whole scattering event at parameter `t` of the ray. */
  private def scatterAt(t: Float, sampler: Sampler): Unit =
    order.step(to = Stage.Evaluated, Stage.Hit, Stage.Escaped)
    path.depth += 1
    val p = ray.at(t)
    val wo = -ray.direction
    val phase = media.media(volumePath.medium).phase
    if guiding != null then
      vertex.scatterAt(p, wo, lobes(volumePath.medium))
      guiding.arrive()
    if caustics != null then caustics.arriveInMedium(eye, p, path)
    if samplesInMedia then addDirect(p, wo, phase, sampler)
    if guiding != null then
      scatter(sampler)
      leave()
    else
      order.step(to = Stage.Departed, Stage.Evaluated)
      sampler.next2D()
      val wi = phase.sample(wo, sampler.x, sampler.y)
      val pdf = phase.value(wo, wi)
      if caustics != null then caustics.scatterInMedium(pdf, path)
      leaveMedium(p, wi, pdf)

  /** Adds light of one light that the medium scatters at `p`. */
  private def addDirect(p: Vec3, wo: Vec3, phase: PhaseFunction, sampler: Sampler): Unit =
    val choice = sampler.next1D(matters = connection.isRandom)
    sampler.next2D()
    if connection.choose(p, Vec3.Zero, choice) &&
      connection.samplePoint(p, sampler.x, sampler.y)
    then
      val value = phase.value(wo, connection.wi)
      if visibility.reaches(p, connection.sample, volumePath.medium) then
        val arrived = arriving(takenPdf(Vec3.Z, value)) * value
        val rivals = caustics
        addSample(
          if rivals == null then arrived
          else arrived * rivals.ofSampleInMedium(connection, p, value, path)
        )

  override def leave(): Unit =
    if !vertex.isInMedium then super.leave()
    else
      order.step(to = Stage.Departed, Stage.Scattered)
      val bounce = vertex.bounce
      val p = vertex.at.p
      if caustics != null then
        caustics.scatterInMedium(vertex.localPdf(bounce.wi), path)
      leaveMedium(p, vertex.at.frame.toWorld(bounce.wi), bounce.pdf)

  /** Leaves a place in the medium, or ends.
    *
    * @param pdf solid-angle density of the direction
    */
  private def leaveMedium(p: Vec3, wi: Vec3, pdf: Float): Unit =
    path.turn(p, Vec3.Zero, if samplesLights then pdf else 0f)
    ray.set(p, wi, Float.PositiveInfinity)
    ray.differential.isKnown = false
    path.isSpread = regularizes
    val map = photons
    if map != null then map.leaveMedium(path)
    goOn()

  override def isAtPane: Boolean = crossesPanes && scene.isPane(vertex.at)

  protected def afterPassing(): Unit = enterMedium()

  protected def afterLeaving(): Unit = enterMedium()

  /** The ray has left the surface of the vertex. */
  private def enterMedium(): Unit =
    volumePath.medium = media.beyond(vertex.at, ray.direction, volumePath.medium)

  protected def drawsAlways: Boolean = true

  def connect(isBoundary: Boolean): Unit =
    order.step(to = Stage.Evaluated, Stage.Sampled)
    val wi = connection.wi
    val localWi = vertex.at.frame.toLocal(wi)
    val f = vertex.received(wi, localWi)
    if !f.isBlack then
      val beyond = media.beyond(vertex.at, wi, volumePath.medium)
      if visibility.reaches(vertex.at.offsetOrigin(wi), connection.sample, beyond) then
        val arrived = arriving(competingPdf(localWi, isBoundary))
        val rivals = caustics
        val misWeight =
          if rivals == null || path.rival == 0.0 || depth == 1 then 1f
          else rivals.ofSample(connection, vertex, localWi, ray, hit, path)
        addSample(arrived * f * (Math.abs(localWi.z) * misWeight))

  /** Adds what the path carries of the light sample. */
  private def addSample(carried: Rgb): Unit =
    found.add(carried)
    if parts != null then parts.addLight(connection.index, depth, carried)

  /** What arrives of the light sample, over its density, times the path's throughput and the weight
    * of multiple importance sampling. Both densities are in units of the path's own, and averages
    * over the colours, each of which might have sampled this path.
    *
    * @param pdf solid-angle density with which the path takes the direction to the light
    */
  private def arriving(pdf: Float): Rgb =
    val w = volumePath.weights
    val s = work.shadow
    val passing = w.ur * s.lr + w.ug * s.lg + w.ub * s.lb
    val byLight = connection.pdf * passing * (1f / 3f)
    val byPath =
      if connection.isDelta then 0f
      else
        // A path that goes straight passes media as a light sample does
        val unscattered = if goesStraight then passing else w.ur * s.ur + w.ug * s.ug + w.ub * s.ub
        pdf * unscattered * (1f / 3f)
    if !(byLight > 0f) then Rgb.Black
    else
      val weight = LightTransport.powerHeuristic(byLight, byPath) / byLight
      w.throughput * s.throughput * connection.sample.radiance.toRgb * weight

object VolumeWalk:
  def apply(
      scene: Scene,
      media: SceneMedia,
      options: WalkOptions,
      guide: Guide | Null = null,
      sharedParts: LightParts | Null = null
  ): VolumeWalk =
    val work = MediumWork()
    new VolumeWalk(scene, media, options, work, VolumePath(work.weights), guide, sharedParts)
