package candela.integrators

import candela.color.Rgb
import candela.film.LightParts
import candela.geometry.Ray
import candela.guiding.Guide
import candela.sampling.Sampler
import candela.scene.Scene

/** Limits of a path tracer's paths.
  *
  * @param maxDepth          scattering events of a path, at most
  * @param rouletteThreshold throughput below which Russian roulette may end a path
  * @param rouletteAfter     scattering events before that
  * @param seesThrough       does light sampling alone find light straight through the boundary of a
  *                          subsurface medium? So in pbrt-v3; v4 weights it against BSDF sampling,
  *                          which does not find it, and loses that part
  */
final case class PathLimits(
    maxDepth: Int,
    rouletteThreshold: Float = 1f,
    rouletteAfter: Int = LightTransport.RouletteAfter,
    seesThrough: Boolean = false
)

/** Unidirectional path tracing with next-event estimation, multiple importance sampling and Russian
  * roulette.
  *
  * @param volumes pbrt-v2's: the camera ray gathers what they emit and scatter, and they attenuate
  *                all other light
  * @param parts   as in [[Walk]]
  *
  * Sources: Kajiya, "The Rendering Equation", SIGGRAPH 1986; Veach 1997, §9 and §10; PBRT 4th ed.,
  * §13.4.
  */
final class PathTracer(
    scene: Scene,
    limits: PathLimits,
    options: WalkOptions = WalkOptions(),
    volumes: VolumeMarch | Null = null,
    parts: LightParts | Null = null
) extends CameraPathIntegrator(scene):
  protected val walk: Walk = Walk(scene, volumes, options = options, sharedParts = parts)
  private val hasVolumes = volumes != null

  protected def over(scene: Scene): PathTracer =
    PathTracer(scene, limits, options, VolumeMarch.copy(volumes))

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    walk.begin(ray, sampler)
    PathLoop.follow(walk, scene, limits, sampler, hasVolumes, light(sampler, _))
    walk.radiance.toRgb

  private def light(sampler: Sampler, isBoundary: Boolean): Unit =
    PathLoop.light(walk, sampler, isBoundary)

/** A path tracer whose paths are guided. */
final class GuidedPathTracer(
    scene: Scene,
    limits: PathLimits,
    options: WalkOptions,
    guide: Guide,
    parts: LightParts | Null
) extends CameraPathIntegrator(scene):
  protected val walk: GuidedWalk = GuidedWalk(scene, options, guide, parts)

  protected def over(scene: Scene): GuidedPathTracer =
    GuidedPathTracer(scene, limits, options, guide, parts)

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    walk.begin(ray, sampler)
    while
      PathLoop.follow(walk, scene, limits, sampler, hasVolumes = false, light(sampler, _))
      walk.followNext(sampler)
    do ()
    walk.finish()
    walk.radiance.toRgb

  private def light(sampler: Sampler, isBoundary: Boolean): Unit =
    PathLoop.light(walk, sampler, isBoundary)

/** The loop of path tracers. It is inlined: the JIT compiler then knows the walk of each. */
private object PathLoop:
  inline def follow[W <: Walk](
      walk: W,
      scene: Scene,
      limits: PathLimits,
      sampler: Sampler,
      inline hasVolumes: Boolean,
      inline light: Boolean => Unit
  ): Unit =
    while walk.goesOn do
      val isHit = walk.intersect()
      if hasVolumes then
        if walk.depth == 0 then walk.marchThroughVolumes(sampler) else walk.attenuateByVolumes()
      if !isHit then walk.addEnvironment()
      else
        walk.addEmission()
        if walk.isPassed then walk.passThrough(limits.maxDepth)
        else if walk.hasHad(limits.maxDepth) then walk.end()
        else
          walk.evaluate()
          light(limits.seesThrough && scene.isSubsurface(walk.vertex.at.material))
          walk.scatter(sampler)
          val inside = walk.beneath
          if inside != null && walk.emerge(inside, sampler) then
            light(false)
            walk.scatter(sampler)
          walk.leave()
          if walk.goesOn && walk.depth > limits.rouletteAfter then
            walk.roulette(limits.rouletteThreshold, sampler)

  /** Adds light of one light.
    *
    * @param isBoundary does light sampling alone find light straight through the surface?
    */
  inline def light[W <: Walk](walk: W, sampler: Sampler, isBoundary: Boolean): Unit =
    if walk.sampleOneLight(sampler) then
      walk.addLight(weight =
        wi =>
          if isBoundary && walk.vertex.crosses(wi) then 1f
          else LightTransport.powerHeuristic(walk.light.pdf, walk.scatterPdf(wi))
      )
