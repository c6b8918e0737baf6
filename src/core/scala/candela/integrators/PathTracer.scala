package candela.integrators

import candela.aov.LightParts
import candela.color.{MutableRgb, Rgb}
import candela.geometry.{Hit, Ray}
import candela.guiding.Guide
import candela.lights.{Light, SurfaceLight}
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** A path from the camera: where it is, and what it has gathered. [[PathState]] says why its
  * estimate is unbiased. Mutable, one per worker.
  */
abstract class CameraPath(
    scene: Scene,
    final val path: PathState,
    final val connection: LightConnection,
    extend: CameraPath => PathExtension
) extends Integrator:
  /** Where the path is. */
  final val vertex: SurfaceVertex = SurfaceVertex(scene)

  /** The ray to the next vertex, and the surface that it has met. */
  final var ray: Ray = Ray()
  final val hit: Hit = Hit()

  /** Radiance so far. */
  final val L: MutableRgb = MutableRgb()

  /** Has the path not ended yet? */
  final var goesOn: Boolean = false

  protected final var rays = 0L
  protected final val extension: PathExtension = extend(this)

  /** [[L]], with what media have emitted. */
  def radianceSoFar: Rgb = L.toRgb

  protected final def startPath(cameraRay: Ray): Unit =
    ray = cameraRay
    L.set(Rgb.Black)
    path.start()
    goesOn = true

  /** Leaves the vertex in its sampled direction, or ends. */
  def leaveVertex(): Unit =
    extension.leaveVertex()
    val bounce = vertex.bounce
    path.startSegment(
      vertex.point.p,
      vertex.lightNormal,
      pdf = if bounce.isSpecular then 0f else bounce.pdf
    )
    path.etaScale *= square(bounce.eta)
    val isOpen = vertex.spawnRay(ray)
    goesOn = isOpen && !path.isBlack

  /** Ends a faint path by Russian roulette.
    *
    * @param own [[path]], whose class is known to the caller
    */
  protected inline def roulette(own: PathState, limits: PathLimits, sampler: Sampler): Unit =
    if goesOn && own.depth >= limits.rouletteDepth then
      val rrBeta = extension.rouletteThroughput(own.throughput.largest * own.etaScale)
      own.scale(LightTransport.roulette(rrBeta, limits.rouletteThreshold, sampler))
      goesOn = !own.isBlack

  def raysTraced: Long = rays + extension.raysTraced
  override def lastMaterial: Int = vertex.point.material
  override def lightParts: LightParts | Null = extension.lightParts

  /** Weight of light that the path meets against light sampling.
    *
    * @param pdf solid-angle density with which light sampling would have sampled the point
    */
  private inline def emissionWeight(light: Int, inline pdf: Float): Float =
    if path.lightSamplingMisses then 1f
    else path.emissionWeight(scene.selection.probability(path.lastP, path.lastN, light), pdf)

  private def isHiddenFromCamera(light: Light): Boolean = path.depth == 0 && !light.isInView

  /** Radiance of the environment along the ray, weighted against light sampling. */
  protected final def environment(): Rgb =
    LightTransport.environment(
      scene,
      ray,
      weight = (i, light) =>
        if isHiddenFromCamera(light) then 0f
        else
          emissionWeight(i, light.pdf(path.lastP, ray.direction)) *
            extension.emissionFactor(i, light)
      ,
      contribution = extension.meetEnvironment
    )

  /** Weight of what the light at the vertex emits against light sampling. */
  protected final def surfaceWeight(light: SurfaceLight): Float =
    val point = vertex.point
    val misWeight =
      if isHiddenFromCamera(light) || light.isShownOnly && !path.lightSamplingMisses then 0f
      else emissionWeight(point.areaLight, light.pdf(path.lastP, point))
    misWeight * extension.emissionFactor(point.areaLight, light)

/** Path tracing over surfaces, with next-event estimation, multiple importance sampling and Russian
  * roulette. [[PathExtension]] has what only some scenes need.
  *
  * [[Interfaces]] say whether light samples end at surfaces that paths pass.
  *
  * Sources: Kajiya, "The Rendering Equation", SIGGRAPH 1986; Veach 1997, §9 and §10; PBRT 4th ed.,
  * §13.4.
  */
final class PathTracer private (
    scene: Scene,
    limits: PathLimits,
    options: PathOptions,
    surfacePath: SurfacePath,
    lights: LightConnection,
    extend: CameraPath => PathExtension
) extends CameraPath(scene, surfacePath, lights, extend):
  import surfacePath.beta
  private val hasLights = scene.lights.length > 0

  override def raysTraced: Long = super.raysTraced + lights.raysTraced

  def radiance(cameraRay: Ray, sampler: Sampler): Rgb =
    startPath(cameraRay)
    lights.startPath(ray.time)
    extension.startPath(sampler)
    while goesOn || extension.nextBranch(sampler) do
      // Trace the ray to the next surface
      rays += 1
      val isHit = scene.closest(ray, hit)
      extension.travel(sampler)
      if !isHit then
        // Add light of the environment
        val Le = environment()
        L.addProduct(beta, Le, 1f)
        goesOn = false
      else
        vertex.hit(ray, hit)
        val point = vertex.point
        // Add light that the surface emits
        if point.areaLight >= 0 then
          val light = scene.surfaceLight(point)
          val Le = light.radiance(point, vertex.wo)
          if !Le.isBlack then
            val weight = surfaceWeight(light)
            L.addProduct(beta, Le, weight)
            extension.meetSurface(point.areaLight, Le, weight)
        if scene.isPassed(ray, hit, point) || extension.isHidden then skipIntersection()
        else if hasHad(limits.maxDepth) then goesOn = false
        else
          surfacePath.depth += 1
          vertex.evaluate()
          extension.arrive()
          // Scatter, and once more where light emerges from beneath the surface
          var isAtVertex = true
          while isAtVertex do
            // Sample direct light
            if hasLights && !vertex.bsdf.isSpecular then
              val u = sampler.next1D(matters = lights.isRandom)
              sampler.next2D()
              if lights.choose(point.p, vertex.lightNormal, u) &&
                lights.samplePoint(point.p, sampler.x, sampler.y) && extension.takesLightSample &&
                lights.computeArrived(
                  vertex,
                  weight = wi =>
                    val bsdfPdf = extension.directionPdf(wi, vertex.localPdf(wi))
                    LightTransport.powerHeuristic(lights.pdf, bsdfPdf)
                )
              then
                lights.arrived.scale(extension.sampleFactor(lights.localWi))
                L.addProduct(beta, lights.arrived)
                extension.recordSample(beta.toRgb * lights.arrived.toRgb)
            extension.addCaustics()
            // Sample the BSDF for the next direction
            if !extension.sampleDirectionInstead(sampler) then
              vertex.draw(sampler)
              beta.scale(vertex.bounce.weight)
            isAtVertex = extension.moveToExit(sampler)
          leaveVertex()
          roulette(surfacePath, limits, sampler)
    L.toRgb

  private def hasHad(events: Int): Boolean = surfacePath.depth + surfacePath.passed == events

  /** Goes on behind the surface, unless the path has had as many events as it may. */
  private def skipIntersection(): Unit =
    if options.countsPassed && !extension.isHidden then
      if hasHad(limits.maxDepth) then goesOn = false else surfacePath.passed += 1
    vertex.passThrough(ray)
    surfacePath.pass(options.interfaces)

object PathTracer:
  /** @param volumes pbrt-v2's volumes, if any
    * @param guide   null: paths are not guided
    * @param parts   where to divide the light, if another integrator does it there, too
    */
  def apply(
      scene: Scene,
      limits: PathLimits,
      options: PathOptions = PathOptions(),
      volumes: VolumeMarch | Null = null,
      guide: Guide | Null = null,
      parts: LightParts | Null = null
  ): PathTracer =
    val passesInterfaces = !options.interfaces.stopsLight
    val lights = LightConnection(scene, volumes, passesInterfaces = passesInterfaces)
    val extend = PathTechniques.of(scene, options, limits.seesThrough, guide, parts, volumes)
    new PathTracer(scene, limits, options, SurfacePath(), lights, extend)
