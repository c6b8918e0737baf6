package candela.integrators

import candela.aov.LightParts
import candela.color.Rgb
import candela.guiding.Guide
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** A [[Walk]] over surfaces, with nothing between them, or with pbrt-v2's volumes. Mutable.
  *
  * [[Interfaces]] say whether light samples end at surfaces that paths pass. If so, a path that has
  * passed one no longer competes with them.
  *
  * @param volumes pbrt-v2's volumes, if any: the camera ray gathers what they emit and scatter, and
  *                they attenuate all other light
  * @param steps   their step size towards lights, in units of that towards the camera
  */
final class SurfaceWalk private (
    scene: Scene,
    volumes: VolumeMarch | Null,
    steps: Float,
    options: WalkOptions,
    surfacePath: SurfacePath,
    guide: Guide | Null,
    sharedParts: LightParts | Null
) extends Walk(
      scene,
      options,
      surfacePath,
      LightConnection(scene, volumes, steps, crosses = !options.interfaces.stopsLight),
      guide,
      sharedParts
    ):
  private val interfaces = options.interfaces

  protected def otherRays: Long =
    connection.raysTraced + (if volumes == null then 0L else volumes.raysTraced)

  protected def start(sampler: Sampler): Unit =
    connection.begin(ray.time)
    if volumes != null then volumes.start(ray, sampler)

  /** Traces the ray to the next surface and computes the vertex; false if it leaves the scene. */
  def intersect(): Boolean =
    val isHit = trace()
    if isHit then meetSurface()
    isHit

  def travel(limits: PathLimits, sampler: Sampler): Boolean =
    if volumes != null then
      if depth == 0 then marchThroughVolumes(sampler)
      else path.scale(volumes.transmittance(ray, steps))
    true

  /** Adds what volumes emit and scatter along the ray just traced, and attenuates the path. */
  def marchThroughVolumes(sampler: Sampler): Unit =
    val march = volumes
    if march != null then
      march.march(ray, sampler, parts)
      found.add(path.throughput * march.added)
      path.scale(march.transmitted)

  protected def afterPassing(): Unit =
    interfaces match
      case Interfaces.Closed => surfacePath.leaveLightSampling(isLost = false)
      case Interfaces.Lossy => surfacePath.leaveLightSampling(isLost = true)
      case _ => ()

  protected def afterLeaving(): Unit = ()

  protected def drawsAlways: Boolean = false

  def connect(isBoundary: Boolean): Unit =
    connectBy(weight =
      wi => LightTransport.powerHeuristic(connection.pdf, competingPdf(wi, isBoundary))
    )

  /** Adds the light sample, if it is visible.
    *
    * @param weight of multiple importance sampling, as in [[LightConnection.scattered]]
    */
  inline def connectBy(inline weight: Vec3 => Float): Unit =
    order.step(to = Stage.Evaluated, Stage.Sampled)
    if caustics == null || path.rival == 0.0 || depth == 1 then
      if connection.scatters(vertex, weight) then addArrived()
    else connectBeside(caustics.nn, weight)

  /** Likewise, where light paths compete. */
  private inline def connectBeside(rivals: CausticWeights, inline weight: Vec3 => Float): Unit =
    if connection.scatters(vertex, weight) then
      connection.arrived
        .scale(rivals.ofSample(connection, vertex, connection.localWi, ray, hit, path))
      addArrived()

  private def addArrived(): Unit =
    surfacePath.addTo(found, connection.arrived)
    if parts != null then
      parts.addLight(connection.index, depth, path.throughput * connection.arrived.toRgb)

  /** Adds light that leaves the vertex towards the path. */
  def addScattered(radiance: Rgb): Unit = found.add(path.throughput * radiance)

  /** Samples a direction in place of the BSDF: `vertex.bounce`.
    *
    * @param bothSides of the surface, with equal density; else of the side where the path came from
    */
  def scatterUniformly(bothSides: Boolean, sampler: Sampler): Unit =
    order.step(to = Stage.Scattered, Stage.Evaluated)
    vertex.drawUniformly(bothSides, sampler)
    path.scale(vertex.bounce.weight)

  /** Samples a specular direction and leaves in it, or ends. Light sampling never competes. */
  def leaveSpecularly(sampler: Sampler): Unit =
    order.step(to = Stage.Departed, Stage.Evaluated)
    val sample = vertex.bsdf.sampleSpecular(vertex.localWo, sampler.next1D())
    path.scale(sample.weight)
    goOn()
    vertex.leave(ray, sample.wi, sample.isSpecular, sample.eta): Unit

object SurfaceWalk:
  def apply(
      scene: Scene,
      volumes: VolumeMarch | Null = null,
      steps: Float = VolumeMarch.StepsToLights,
      options: WalkOptions = WalkOptions(),
      guide: Guide | Null = null,
      sharedParts: LightParts | Null = null
  ): SurfaceWalk =
    new SurfaceWalk(scene, volumes, steps, options, SurfacePath(), guide, sharedParts)
