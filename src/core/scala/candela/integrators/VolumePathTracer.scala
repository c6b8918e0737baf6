package candela.integrators

import candela.color.Rgb
import candela.film.LightParts
import candela.geometry.Ray
import candela.guiding.Guide
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
    options: WalkOptions = WalkOptions(),
    parts: LightParts | Null = null
) extends CameraPathIntegrator(scene):
  protected val walk: VolumeWalk = VolumeWalk(scene, media, options, parts)

  protected def over(scene: Scene): VolumePathTracer =
    VolumePathTracer(scene, media, limits, options)

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    walk.begin(ray, sampler)
    VolumePathLoop.follow(walk, scene, limits, options, sampler, light(sampler, _))
    walk.total

  private def light(sampler: Sampler, isBoundary: Boolean): Unit =
    VolumePathLoop.light(walk, sampler, isBoundary)

/** A path tracer through participating media whose paths are guided. */
final class GuidedVolumePathTracer(
    scene: Scene,
    media: SceneMedia,
    limits: PathLimits,
    options: WalkOptions,
    guide: Guide,
    parts: LightParts | Null
) extends CameraPathIntegrator(scene):
  protected val walk: GuidedVolumeWalk = GuidedVolumeWalk(scene, media, options, guide, parts)

  protected def over(scene: Scene): GuidedVolumePathTracer =
    GuidedVolumePathTracer(scene, media, limits, options, guide, parts)

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    walk.begin(ray, sampler)
    while
      VolumePathLoop.follow(walk, scene, limits, options, sampler, light(sampler, _))
      walk.followNext(sampler)
    do ()
    walk.finish()
    walk.total

  private def light(sampler: Sampler, isBoundary: Boolean): Unit =
    VolumePathLoop.light(walk, sampler, isBoundary)

/** As [[PathLoop]]. */
private object VolumePathLoop:
  inline def follow[W <: VolumeWalk](
      walk: W,
      scene: Scene,
      limits: PathLimits,
      options: WalkOptions,
      sampler: Sampler,
      inline light: Boolean => Unit
  ): Unit =
    // Media where the last event could be shine, too, if paths find light only where they hit it
    val endsShine = !options.samplesLights
    while walk.goesOn do
      val isHit = walk.intersect()
      val scattered =
        walk.sampleMedium(emits = walk.depth < limits.maxDepth || endsShine, sampler)
      if walk.isAbsorbed then walk.end()
      else if scattered >= 0f then
        if walk.depth == limits.maxDepth then walk.end()
        else
          walk.scatterInMedium(scattered, sampler)
          surviveRoulette(walk, limits, sampler)
      else if !isHit then walk.addEnvironment()
      else
        walk.meetSurface()
        walk.addEmission()
        if walk.isPassed then walk.passThrough()
        else if walk.isAtPane then
          walk.meetPane()
          if !walk.vertex.bsdf.isSpecular && walk.depth <= limits.maxDepth then light(false)
          walk.crossPane(sampler)
          if walk.depth > limits.maxDepth then walk.end()
          surviveRoulette(walk, limits, sampler)
        else if walk.depth == limits.maxDepth then walk.end()
        else
          walk.evaluate()
          light(limits.seesThrough && scene.isSubsurface(walk.vertex.at.material))
          walk.scatter(sampler)
          val inside = walk.beneath
          if inside != null && walk.emerge(inside, sampler) then
            light(false)
            walk.scatter(sampler)
          walk.leave()
          surviveRoulette(walk, limits, sampler)

  /** @param isBoundary as in [[PathLoop]] */
  inline def light[W <: VolumeWalk](walk: W, sampler: Sampler, isBoundary: Boolean): Unit =
    if walk.sampleOneLight(sampler) then
      walk.addLight(scatterPdf =
        wi => if isBoundary && walk.vertex.crosses(wi) then 0f else walk.scatterPdf(wi)
      )

  private inline def surviveRoulette[W <: VolumeWalk](
      walk: W,
      limits: PathLimits,
      sampler: Sampler
  ): Unit =
    if walk.goesOn && walk.depth > limits.rouletteAfter then
      walk.roulette(limits.rouletteThreshold, sampler)
