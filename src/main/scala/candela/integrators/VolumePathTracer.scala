package candela.integrators

import candela.color.Rgb
import candela.geometry.Ray
import candela.media.SceneMedia
import candela.sampling.Sampler
import candela.scene.Scene

/** Path tracing through participating media: surfaces and media scatter a path, and light samples
  * are attenuated on their way, also through interfaces.
  *
  * Sources: see [[PathTracer]] for surfaces, [[candela.media.PathWeights]] for the weights of
  * colours; both kinds of densities are combined by the power heuristic, where Miller, Georgiev and
  * Jarosz 2019 use the balance heuristic.
  */
final class VolumePathTracer(
    scene: Scene,
    media: SceneMedia,
    limits: PathLimits,
    options: WalkOptions = WalkOptions()
) extends CameraPathIntegrator(scene):
  import limits.*

  // Media where the last event could be shine, too, if paths find light only where they hit it
  private val endsShine = !options.samplesLights
  protected val walk: VolumeWalk = VolumeWalk(scene, media, options)

  protected def over(scene: Scene): VolumePathTracer =
    VolumePathTracer(scene, media, limits, options)

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    walk.begin(ray, sampler)
    while walk.goesOn do
      val isHit = walk.intersect()
      val scattered = walk.sampleMedium(emits = walk.depth < maxDepth || endsShine, sampler)
      if walk.isAbsorbed then walk.end()
      else if scattered >= 0f then
        if walk.depth == maxDepth then walk.end()
        else
          walk.scatterInMedium(scattered, sampler)
          surviveRoulette(sampler)
      else if !isHit then walk.addEnvironment()
      else
        walk.meetSurface()
        walk.addEmission()
        if walk.isPassed then walk.passThrough()
        else if walk.isAtPane then
          walk.crossPane(sampler)
          if walk.depth > maxDepth then walk.end()
          surviveRoulette(sampler)
        else if walk.depth == maxDepth then walk.end()
        else
          walk.evaluate()
          addOneLight(
            sampler,
            isBoundary = seesThrough && scene.isSubsurface(walk.vertex.at.material)
          )
          walk.scatter(sampler)
          val inside = walk.beneath
          if inside != null && walk.emerge(inside, sampler) then
            addOneLight(sampler, isBoundary = false)
            walk.scatter(sampler)
          walk.leave()
          surviveRoulette(sampler)
    walk.total

  /** @param isBoundary as in [[PathTracer]] */
  private def addOneLight(sampler: Sampler, isBoundary: Boolean): Unit =
    if walk.sampleOneLight(sampler) then
      walk.addLight(scatterPdf =
        wi => if isBoundary && walk.vertex.crosses(wi) then 0f else walk.vertex.localPdf(wi)
      )

  private def surviveRoulette(sampler: Sampler): Unit =
    if walk.goesOn && walk.depth > rouletteAfter then walk.roulette(rouletteThreshold, sampler)
