package candela.integrators

import candela.aov.LightParts
import candela.color.Rgb
import candela.geometry.Ray
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** An integrator that follows a path over surfaces, other than the path tracers: it is an order of
  * these steps. Mutable, one per worker.
  *
  * At each vertex: [[intersect]] gets there; [[addEnvironment]] or [[addEmission]] adds what the
  * ray has met; [[evaluate]] prepares the vertex; [[sampleLight]] and [[connectBy]] add light of an
  * emitter; [[scatter]] samples the next direction, and [[leaveVertex]] takes it.
  *
  * @param volumes    pbrt-v2's volumes, if any: the camera ray gathers what they emit and scatter,
  *                   and they attenuate all other light
  * @param steps      their step size towards lights, in units of that towards the camera
  * @param interfaces what they are to light sampling
  */
abstract class SurfaceWalk(
    scene: Scene,
    volumes: VolumeMarch | Null = null,
    steps: Float = VolumeMarch.StepsToLights,
    interfaces: Interfaces = Interfaces.Open,
    surfacePath: SurfacePath = SurfacePath()
) extends CameraPath(
      scene,
      surfacePath,
      LightConnection(scene, volumes, steps, passesInterfaces = !interfaces.stopsLight),
      PathTechniques.of(scene, PathOptions(), seesThrough = false, null, null)
    ):
  /** Its users divide light only if they say so. */
  override def lightParts: LightParts | Null = null

  override def raysTraced: Long =
    super.raysTraced + connection.raysTraced + (if volumes == null then 0L else volumes.raysTraced)

  /** Starts a path along a camera ray, which the walk overwrites. */
  protected final def startPath(cameraRay: Ray, sampler: Sampler): Unit =
    startPath(cameraRay)
    connection.startPath(ray.time)
    if volumes != null then volumes.start(ray, sampler)
    extension.startPath(sampler)

  protected final def end(): Unit = goesOn = false

  /** Traces the ray to the next surface and computes the vertex; false if it leaves the scene. */
  protected final def intersect(): Boolean =
    rays += 1
    val isHit = scene.closest(ray, hit)
    if isHit then vertex.hit(ray, hit)
    isHit

  /** Adds what volumes emit and scatter along the ray just traced, and attenuates the path. */
  protected final def marchThroughVolumes(sampler: Sampler): Unit =
    val march = volumes
    if march != null then
      march.march(ray, sampler, extension.lightParts)
      addScattered(march.added)
      path.scale(march.transmitted)

  /** Adds the environment's radiance and ends the path. */
  protected final def addEnvironment(): Unit =
    val Le = environment()
    L.addProduct(surfacePath.beta, Le, 1f)
    end()

  /** Adds what the surface emits. */
  protected final def addEmission(): Unit =
    addEmission((Le, weight) => L.addProduct(surfacePath.beta, Le, weight))

  /** Does light pass here unscattered? */
  protected final def isPassed: Boolean = scene.isPassed(ray, hit, vertex.point)

  /** Continues through an interface. */
  protected final def passThrough(): Unit =
    vertex.passThrough(ray)
    surfacePath.pass(interfaces)

  /** Evaluates the BSDF of the vertex: a scattering event. */
  protected final def evaluate(): Unit =
    path.depth += 1
    vertex.evaluate()
    extension.arrive()

  /** Chooses one light and samples a point on it; false if it contributes nothing. */
  protected final def sampleLight(sampler: Sampler): Boolean =
    scene.lights.length > 0 && !vertex.bsdf.isSpecular &&
      sampleLight(vertex.point.p, vertex.lightNormal, sampler, isUsed = true)

  /** Adds the light sample, if it is visible.
    *
    * @param weight of multiple importance sampling, as in [[LightConnection.scattered]]
    */
  protected inline def connectBy(inline weight: Vec3 => Float): Unit =
    if connection.computeArrived(vertex, weight) then addArrived()

  protected final def addArrived(): Unit =
    connection.arrived.scale(surfacePath.beta)
    L.add(connection.arrived)
    extension.recordSample()

  /** Adds light that leaves the vertex towards the path. */
  protected final def addScattered(radiance: Rgb): Unit = L.add(path.throughput * radiance)

  /** Samples the next direction: `vertex.bounce`. */
  protected final def scatter(sampler: Sampler): Unit =
    vertex.draw(sampler)
    path.scale(vertex.bounce.weight)

  /** Likewise, in place of the BSDF.
    *
    * @param bothSides of the surface, with equal density; else of the side where the path came from
    */
  protected final def scatterUniformly(bothSides: Boolean, sampler: Sampler): Unit =
    vertex.drawUniformly(bothSides, sampler)
    path.scale(vertex.bounce.weight)

  /** Samples a specular direction and leaves in it, or ends. */
  protected final def leaveSpecularly(sampler: Sampler): Unit =
    val sample = vertex.bsdf.sampleSpecular(vertex.localWo, sampler.next1D())
    path.scale(sample.weight)
    vertex.spawnRay(ray, sample.wi, sample.isSpecular, sample.eta): Unit
    goesOn = !path.isBlack
