package candela.integrators

import candela.bsdf.Bssrdf
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
    guidance.scatter(throughput.toRgb.average, radiance.toRgb.average, sampler)
    throughput.scale(vertex.bounce.weight)

  override def roulette(threshold: Float, sampler: Sampler): Unit =
    throughput.scale(guidance.roulette(throughput.largest * etaScale, threshold, sampler))
    goesOn = !throughput.isBlack

  /** All light of the path is found. */
  def finish(): Unit = guidance.finish(radiance.toRgb.average)
