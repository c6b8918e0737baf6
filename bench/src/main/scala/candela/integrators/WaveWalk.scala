package candela.integrators

import candela.geometry.{Hit, Ray}
import candela.math.*
import candela.sampling.Sampler
import candela.scene.Scene

/** The walk of [[SurfaceWalk]] cut at its rays: one vertex at a time, after which its two rays wait
  * to be traced, the path's own and that of the light sample. Paths are kept elsewhere meanwhile
  * ([[PathWave]]). All that happens at a vertex is done by the steps of [[Walk]].
  */
private[candela] final class WaveWalk(scene: Scene, limits: PathLimits, surfacePath: SurfacePath)
    extends Walk(
      scene,
      WalkOptions(),
      surfacePath,
      LightConnection(scene),
      guide = null,
      sharedParts = null
    ):
  private var own = 0L

  /** Does a light sample wait for its ray? */
  var waits: Boolean = false

  /** What it adds if it is visible, weighted with the throughput. */
  var pendingR, pendingG, pendingB: Float = 0f

  def departing: Ray = ray
  def met: Hit = hit
  def shadow: Ray = connection.ray
  def isAlive: Boolean = goesOn

  def setFound(r: Float, g: Float, b: Float): Unit =
    found.r = r
    found.g = g
    found.b = b
  def foundR: Float = found.r
  def foundG: Float = found.g
  def foundB: Float = found.b

  protected def otherRays: Long = own
  protected def start(sampler: Sampler): Unit = connection.begin(ray.time)
  def travel(limits: PathLimits, sampler: Sampler): Boolean = true
  protected def afterPassing(): Unit = ()
  protected def drawsAlways: Boolean = false

  /** Goes on at what the ray has met, up to the next one.
    *
    * @param isHit does it meet anything?
    */
  def follow(isHit: Boolean, sampler: Sampler): Unit =
    waits = false
    goOn()
    order.set(if isHit then Stage.Hit else Stage.Escaped)
    if !isHit then addEnvironment()
    else
      meetSurface()
      addEmission()
      if isPassed then passThrough(limits.maxDepth)
      else if hasHad(limits.maxDepth) then end()
      else bounce(sampler)

  /** Apart, as in [[PathTracer]]. */
  private def bounce(sampler: Sampler): Unit =
    evaluate()
    if sampleLight(sampler) then connect(isBoundary = false)
    scatter(sampler)
    leave()
    if goesOn && depth > limits.rouletteAfter then roulette(limits.rouletteThreshold, sampler)

  /** As [[LightConnection.scatters]], as if the light sample were visible: its ray waits. */
  def connect(isBoundary: Boolean): Unit =
    order.step(to = Stage.Evaluated, Stage.Sampled)
    val localWi = connection.localWi
    vertex.at.frame.toLocal(connection.wi, localWi)
    val f = vertex.received(connection.wi, localWi)
    if !f.isBlack then
      connection.aim(vertex.at.offsetOrigin(connection.wi))
      val weight =
        if connection.isDelta then 1f
        else LightTransport.powerHeuristic(connection.pdf, competingPdf(localWi, isBoundary))
      connection.arrive(f, Math.abs(localWi.z) * weight / connection.pdf)
      val arrived = connection.arrived
      val beta = surfacePath.throughput
      pendingR = beta.r * arrived.r
      pendingG = beta.g * arrived.g
      pendingB = beta.b * arrived.b
      waits = true

  protected def afterLeaving(): Unit = ()
