package candela.integrators

import candela.aov.LightParts
import candela.color.Rgb
import candela.geometry.Ray
import candela.guiding.Guide
import candela.media.SceneMedia
import candela.sampling.Sampler
import candela.scene.Scene

/** Unidirectional path tracing with next-event estimation, multiple importance sampling and Russian
  * roulette, over surfaces or through participating media, guided or not.
  *
  * Sources: Kajiya, "The Rendering Equation", SIGGRAPH 1986; Veach 1997, §9 and §10; PBRT 4th ed.,
  * §13.4; in media also [[candela.media.PathWeights]]. Both kinds of densities are combined by the
  * power heuristic, where Miller, Georgiev and Jarosz 2019 use the balance heuristic.
  */
final class PathTracer private[integrators] (
    scene: Scene,
    limits: PathLimits,
    protected val walk: Walk
) extends CameraPathIntegrator:

  def radiance(ray: Ray, sampler: Sampler): Rgb =
    walk.begin(ray, sampler)
    while
      follow(sampler)
      walk.followNext(sampler)
    do ()
    walk.radiance

  /** Follows the path, or a branch of it, to its end. Scattering is apart: together they are more
    * than the JIT compiler inlines, and it would leave calls in the midst of either.
    */
  private inline def follow(sampler: Sampler): Unit =
    while walk.goesOn do
      val isHit = walk.trace()
      if !walk.travel(limits, sampler) then survive(sampler)
      else if !isHit then walk.addEnvironment()
      else
        walk.meetSurface()
        walk.addEmission()
        if walk.isPassed then walk.passThrough(limits.maxDepth)
        else if walk.isAtPane then scatterAtPane(sampler)
        else if walk.hasHad(limits.maxDepth) then walk.end()
        else scatter(sampler)

  private def scatter(sampler: Sampler): Unit =
    walk.evaluate()
    addDirect(limits.seesThrough && scene.isSubsurface(walk.vertex.at.material), sampler)
    walk.addCaustics(sampler)
    walk.scatter(sampler)
    val inside = walk.beneath
    if inside != null && walk.emerge(inside, sampler) then
      addDirect(isBoundary = false, sampler)
      walk.scatter(sampler)
    walk.leave()
    survive(sampler)

  /** Scattering is an event only if the path does not cross the pane. */
  private def scatterAtPane(sampler: Sampler): Unit =
    walk.evaluate(isGuided = false)
    if !walk.vertex.bsdf.isSpecular && walk.depth <= limits.maxDepth then
      addDirect(isBoundary = false, sampler)
    walk.crossPane(sampler)
    if walk.depth > limits.maxDepth then walk.end()
    survive(sampler)

  /** Adds light of one light.
    *
    * @param isBoundary does light sampling alone find light straight through the surface?
    */
  private def addDirect(isBoundary: Boolean, sampler: Sampler): Unit =
    if walk.sampleLight(sampler) then walk.connect(isBoundary)

  private def survive(sampler: Sampler): Unit =
    if walk.goesOn && walk.depth > limits.rouletteAfter then
      walk.roulette(limits.rouletteThreshold, sampler)

object PathTracer:
  /** Over surfaces.
    *
    * @param guide   null: paths are not guided
    * @param parts   as in [[Walk]]
    */
  def apply(
      scene: Scene,
      limits: PathLimits,
      options: WalkOptions = WalkOptions(),
      volumes: VolumeMarch | Null = null,
      guide: Guide | Null = null,
      parts: LightParts | Null = null
  ): PathTracer =
    val walk = SurfaceWalk(scene, volumes, options = options, guide = guide, sharedParts = parts)
    new PathTracer(scene, limits, walk)

/** Path tracing through participating media. Not with [[PathTracer]]'s own: a JVM should load the
  * one kind of walk that it needs.
  */
object VolumePathTracer:
  def apply(
      scene: Scene,
      media: SceneMedia,
      limits: PathLimits,
      options: WalkOptions = WalkOptions(),
      guide: Guide | Null = null,
      parts: LightParts | Null = null
  ): PathTracer =
    new PathTracer(scene, limits, VolumeWalk(scene, media, options, guide, parts))
