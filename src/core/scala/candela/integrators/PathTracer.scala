package candela.integrators

import candela.aov.LightParts
import candela.color.Rgb
import candela.geometry.Ray
import candela.guiding.Guide
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

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
    lightConnection: LightConnection,
    extend: CameraPath => PathExtension
) extends CameraPath(scene, surfacePath, lightConnection, extend):
  import surfacePath.beta
  private val hasLights = scene.lights.length > 0

  override def raysTraced: Long = super.raysTraced + connection.raysTraced

  def radiance(cameraRay: Ray, sampler: Sampler): Rgb =
    startPath(cameraRay)
    connection.startPath(ray.time)
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
        addEmission((Le, weight) => L.addProduct(beta, Le, weight))
        if scene.isPassed(ray, hit, point) || extension.isHidden then skipIntersection()
        else if isAtMaxDepth then goesOn = false
        else
          surfacePath.depth += 1
          vertex.evaluate()
          extension.arrive()
          // Scatter, and once more where light emerges from beneath the surface
          var isAtVertex = true
          while isAtVertex do
            // Sample direct light
            if hasLights && !vertex.bsdf.isSpecular &&
              sampleLight(point.p, vertex.lightNormal, sampler, isUsed = true) &&
              extension.takesLightSample &&
              connection.computeArrived(
                vertex,
                weight = wi =>
                  val bsdfPdf = extension.directionPdf(wi, vertex.localPdf(wi))
                  LightTransport.powerHeuristic(connection.pdf, bsdfPdf)
              )
            then
              connection.arrived.scale(extension.sampleFactor(connection.localWi))
              connection.arrived.scale(beta)
              L.add(connection.arrived)
              extension.recordSample()
            extension.addCaustics()
            // Sample the BSDF for the next direction
            if !extension.sampleDirectionInstead(sampler) then
              vertex.draw(sampler)
              beta.scale(vertex.bounce.weight)
            isAtVertex = extension.moveToExit(sampler)
          leaveVertex()
          roulette(surfacePath, limits, sampler)
    L.toRgb

  private def isAtMaxDepth: Boolean = surfacePath.depth + surfacePath.passed == limits.maxDepth

  /** Goes on behind the surface, unless the path has had as many events as it may. */
  private def skipIntersection(): Unit =
    if options.countsPassed && !extension.isHidden then
      if isAtMaxDepth then goesOn = false else surfacePath.passed += 1
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
    val connection = LightConnection(scene, volumes, passesInterfaces = passesInterfaces)
    val extend = PathTechniques.of(scene, options, limits.seesThrough, guide, parts, volumes)
    new PathTracer(scene, limits, options, SurfacePath(), connection, extend)
