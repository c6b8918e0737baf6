package candela.integrators

import candela.aov.LightParts
import candela.color.{MutableRgb, Rgb}
import candela.geometry.{Hit, Ray}
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
    * @param state [[path]], whose class is known to the caller
    */
  protected inline def roulette(state: PathState, limits: PathLimits, sampler: Sampler): Unit =
    if goesOn && state.depth >= limits.rouletteDepth then
      val rrBeta = extension.rouletteThroughput(state.throughput.largest * state.etaScale)
      state.scale(LightTransport.roulette(rrBeta, limits.rouletteThreshold, sampler))
      goesOn = !state.isBlack

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

  /** Adds light that the surface emits, by `add`: its radiance and weight. */
  protected inline def addEmission(inline add: (Rgb, Float) => Unit): Unit =
    val point = vertex.point
    if point.areaLight >= 0 then
      val light = scene.surfaceLight(point)
      val Le = light.radiance(point, vertex.wo)
      if !Le.isBlack then
        val weight = surfaceWeight(light)
        add(Le, weight)
        extension.meetSurface(point.areaLight, Le, weight)

  /** Chooses a light and samples a point on it; false if it contributes nothing.
    *
    * @param n      normal for the choice of lights
    * @param isUsed false: the random numbers are drawn all the same
    */
  protected inline def sampleLight(
      p: Vec3,
      n: Vec3,
      sampler: Sampler,
      inline isUsed: Boolean
  ): Boolean =
    val u = sampler.next1D(matters = connection.isRandom)
    sampler.next2D()
    isUsed && connection.choose(p, n, u) && connection.samplePoint(p, sampler.x, sampler.y)

  /** Weight of what the light at the vertex emits against light sampling. */
  protected final def surfaceWeight(light: SurfaceLight): Float =
    val point = vertex.point
    val misWeight =
      if isHiddenFromCamera(light) || light.isShownOnly && !path.lightSamplingMisses then 0f
      else emissionWeight(point.areaLight, light.pdf(path.lastP, point))
    misWeight * extension.emissionFactor(point.areaLight, light)
