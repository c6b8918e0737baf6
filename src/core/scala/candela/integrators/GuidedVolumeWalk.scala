package candela.integrators

import candela.bsdf.{Bssrdf, PhaseLobe}
import candela.film.LightParts
import candela.geometry.Ray
import candela.guiding.Guide
import candela.math.*
import candela.media.SceneMedia
import candela.sampling.{PhaseFunction, Sampler}
import candela.scene.Scene

/** A [[VolumeWalk]] with [[Guidance]], on surfaces and in media. */
final class GuidedVolumeWalk(
    scene: Scene,
    media: SceneMedia,
    options: WalkOptions,
    guide: Guide,
    parts: LightParts | Null
) extends VolumeWalk(scene, media, options, parts),
      BranchingWalk[VolumeWalk.State]:
  protected val guidance: Guidance = Guidance(guide, vertex)
  protected val branches: Branches[VolumeWalk.State] = Branches(() => VolumeWalk.State())
  private val lobes = media.media.map(medium => PhaseLobe(medium.phase))

  override def begin(cameraRay: Ray, sampler: Sampler): Unit =
    super.begin(cameraRay, sampler)
    guidance.begin(cameraRay)

  override protected def arrive(p: Vec3, wo: Vec3): Unit =
    vertex.scatterAt(p, wo, lobes(medium))
    guidance.arrive()

  override protected def phasePdf(value: Float): Float =
    guidance.pdf(Vec3.Z, light.wi, value)

  override protected def turn(phase: PhaseFunction, p: Vec3, wo: Vec3, sampler: Sampler): Unit =
    scatterGuided(sampler)
    leaveInMedium()

  private def leaveInMedium(): Unit =
    val bounce = vertex.bounce
    leaveInMedium(vertex.at.p, vertex.at.frame.toWorld(bounce.wi), bounce.pdf)

  protected def leaveInBranch(): Unit =
    if vertex.isInMedium then leaveInMedium() else leave()

  override def evaluate(): Unit =
    super.evaluate()
    guidance.arrive()

  override def meetPane(): Unit =
    guidance.leaveAlone()
    super.meetPane()

  override def emerge(inside: Bssrdf, sampler: Sampler): Boolean =
    guidance.leaveAlone()
    super.emerge(inside, sampler)

  override def scatterPdf(local: Vec3): Float =
    guidance.pdf(local, light.wi, vertex.localPdf(local))

  override def scatter(sampler: Sampler): Unit = scatterGuided(sampler)

  private def scatterGuided(sampler: Sampler): Unit =
    weights.scale(guidance.survival(weights.throughput.average, sampler))
    if guidance.branches == 1 then scatterOnce(0)
    else
      leaveInBranches()
      weights.scale(0f)

  protected def found: Float = total.average

  protected def scatterOnce(branch: Int): Unit =
    guidance.scatter(weights.throughput.average, found, branch)
    weights.scale(vertex.bounce.weight)

  override def roulette(threshold: Float, sampler: Sampler): Unit =
    weights.scale(guidance.roulette(weights.brightest * etaScale, threshold, sampler))
    goesOn = !isAbsorbed
