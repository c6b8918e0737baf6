package candela.integrators

import candela.color.Rgb
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
  * @param guide   learns from where light comes, if paths are to be guided
  *
  * Sources: Kajiya, "The Rendering Equation", SIGGRAPH 1986; Veach 1997, §9 and §10; PBRT 4th ed.,
  * §13.4.
  */
final class PathTracer(
    scene: Scene,
    limits: PathLimits,
    options: WalkOptions = WalkOptions(),
    volumes: VolumeMarch | Null = null,
    guide: Guide | Null = null
) extends CameraPathIntegrator(scene):
  import limits.*

  protected val walk: Walk =
    if guide == null then Walk(scene, volumes, options = options)
    else GuidedWalk(scene, volumes, options, guide)
  private val hasVolumes = volumes != null

  protected def over(scene: Scene): PathTracer =
    PathTracer(scene, limits, options, VolumeMarch.copy(volumes), guide)

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    walk.begin(ray, sampler)
    while walk.goesOn do
      val isHit = walk.intersect()
      if hasVolumes then
        if walk.depth == 0 then walk.marchThroughVolumes(sampler) else walk.attenuateByVolumes()
      if !isHit then walk.addEnvironment()
      else
        walk.addEmission()
        if walk.isPassed then walk.passThrough()
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
          if walk.goesOn && walk.depth > rouletteAfter then
            walk.roulette(rouletteThreshold, sampler)
    walk.finish()
    walk.radiance.toRgb

  /** @param isBoundary does light sampling alone find light straight through the surface? */
  private def addOneLight(sampler: Sampler, isBoundary: Boolean): Unit =
    if walk.sampleOneLight(sampler) then
      val light = walk.light
      walk.addLight(weight =
        wi =>
          if isBoundary && walk.vertex.crosses(wi) then 1f
          else LightTransport.powerHeuristic(light.pdf, walk.scatterPdf(wi))
      )
