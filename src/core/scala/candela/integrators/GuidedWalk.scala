package candela.integrators

import candela.bsdf.Bssrdf
import candela.color.Rgb
import candela.film.LightParts
import candela.geometry.Ray
import candela.guiding.Guide
import candela.math.Vec3
import candela.sampling.Sampler
import candela.scene.Scene

/** A [[Walk]] with [[Guidance]]. */
final class GuidedWalk(
    scene: Scene,
    options: WalkOptions,
    guide: Guide,
    parts: LightParts | Null
) extends Walk(scene, options = options, sharedParts = parts),
      BranchingWalk[Walk.State]:
  protected val guidance: Guidance = Guidance(guide, vertex)
  protected val branches: Branches[Walk.State] = Branches(() => Walk.State())

  override def begin(cameraRay: Ray, sampler: Sampler): Unit =
    super.begin(cameraRay, sampler)
    guidance.begin(cameraRay)

  override def evaluate(): Unit =
    super.evaluate()
    guidance.arrive()

  override def emerge(inside: Bssrdf, sampler: Sampler): Boolean =
    guidance.leaveAlone()
    super.emerge(inside, sampler)

  override def scatterPdf(local: Vec3): Float =
    guidance.pdf(local, light.wi, vertex.localPdf(local))

  override def scatter(sampler: Sampler): Unit =
    throughput.scale(guidance.survival(throughput.toRgb.average, sampler))
    if guidance.branches == 1 then scatterOnce(0)
    else
      leaveInBranches()
      throughput.set(Rgb.Black)

  protected def found: Float = radiance.toRgb.average

  protected def scatterOnce(branch: Int): Unit =
    guidance.scatter(throughput.toRgb.average, found, branch)
    throughput.scale(vertex.bounce.weight)

  protected def leaveInBranch(): Unit = leave()

  override def roulette(threshold: Float, sampler: Sampler): Unit =
    throughput.scale(guidance.roulette(throughput.largest * etaScale, threshold, sampler))
    goesOn = !throughput.isBlack
