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
) extends Walk(scene, options = options, sharedParts = parts):
  private val guidance = Guidance(guide, vertex)
  private val branches = Branches(guidance, () => Walk.State())

  override def begin(cameraRay: Ray, sampler: Sampler): Unit =
    super.begin(cameraRay, sampler)
    guidance.begin()

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
    if guidance.branches == 1 then scatterOnce(0) else scatterInBranches()

  private def scatterOnce(branch: Int): Unit =
    guidance.scatter(throughput.toRgb.average, radiance.toRgb.average, branch)
    throughput.scale(vertex.bounce.weight)

  /** Leaves in all branches, which wait, and ends. */
  private def scatterInBranches(): Unit =
    branches.divide(
      keep(_),
      follow(_),
      branch =>
        scatterOnce(branch)
        leave()
        goesOn
    )
    throughput.set(Rgb.Black)

  private def follow(branch: Branches.Branch[Walk.State]): Unit =
    goOn(branch.state)
    guidance.follow(branch.mark, radiance.toRgb.average)

  /** Goes on with a branch that waits; false: none. */
  def followNext(sampler: Sampler): Boolean = branches.followNext(sampler, follow(_))

  override def roulette(threshold: Float, sampler: Sampler): Unit =
    throughput.scale(guidance.roulette(throughput.largest * etaScale, threshold, sampler))
    goesOn = !throughput.isBlack

  /** All light of the path is found. */
  def finish(): Unit = guidance.finish(radiance.toRgb.average)
