package candela.photons

import candela.base.loop
import candela.bdpt.{LightPaths, PathVertex}
import candela.concurrency.GivenUp
import candela.cameras.Shutter
import candela.film.View
import candela.integrators.{Interfaces, PassIntegrator, SharedPasses}
import candela.sampling.{IndependentSampler, SampleHash, Sampler}
import candela.scene.{PathReport, Scene}

import java.util.concurrent.atomic.AtomicInteger
import java.util.concurrent.locks.LockSupport

/** Photon mapping settings.
  *
  * @param radius   initial gathering radius, in scene units
  * @param paths    light paths per pass; at most 0: one per pixel
  * @param maxEdges maximum number of edges of a light path
  * @param seed     random seed
  * @param caustics whether to store photons that arrive via specular surfaces only
  * @param indirect whether to store all others
  * @param gathersGloss whether to gather on surfaces without a diffuse lobe, too, as in pbrt-v2
  */
final case class PhotonSettings(
    radius: Float,
    paths: Int,
    maxEdges: Int,
    compresses: Boolean,
    seed: Int = 0,
    caustics: Boolean = true,
    indirect: Boolean = true,
    gathersGloss: Boolean = false
)

/** Traces the photons of a pass. Mutable, one per worker. */
private[candela] abstract class PhotonTracer(seed: Int):
  private val sampler = IndependentSampler(1, seed)

  def raysTraced: Long

  /** A random number of the pass, deterministic for any worker. */
  final def draw(pass: Int): Long = SampleHash.pixel(pass, -1, seed)

  /** Traces a light path, and stores the photons that have arrived at its vertices, if they are of
    * the kind.
    */
  protected def trace(time: Float, sampler: Sampler, photons: Photons): Unit

  /** Traces one part of a pass, deterministic for any worker, unless it is stopped on the way. */
  final def trace(
      pass: Int,
      part: Int,
      count: Int,
      shutter: Shutter,
      isStopped: () => Boolean
  ): Photons =
    val photons = Photons()
    var i = 0
    while i < count && !isStopped() do
      sampler.start(part * PhotonMaps.PartSize + i, -1, pass)
      trace(shutter.at(sampler.next1D()), sampler, photons)
      i += 1
    photons

/** Traces all photons but those of direct light. */
private[candela] final class WholePhotons(scene: Scene, settings: PhotonSettings)
    extends PhotonTracer(settings.seed):
  private val paths =
    LightPaths(
      scene,
      settings.maxEdges,
      rouletteDepth = 1,
      settings.compresses,
      weighsAll = false,
      startsAlone = scene.isDispersive
    )

  def raysTraced: Long = paths.raysTraced

  protected def trace(time: Float, sampler: Sampler, photons: Photons): Unit =
    paths.trace(time, sampler)
    loop(paths.count)(k => store(paths(k), photons))

  private def store(vertex: PathVertex, photons: Photons): Unit =
    val isKept = if vertex.isSpecularSoFar then settings.caustics else settings.indirect
    if vertex.edges > 1 && isKept then photons.add(vertex.point.p, vertex.wo, vertex.throughput)

/** The photon maps of all passes, shared by all workers. A worker that needs a map helps to build
  * it; the map is bit-identical for any thread count.
  *
  * The radius shrinks with each pass, so that bias and noise of the average over all passes vanish
  * in the limit: r² by (k + α)/(k + 1), α = 2/3.
  *
  * Source: Knaus and Zwicker, "Progressive Photon Mapping: A Probabilistic Approach", TOG 30(3),
  * 2011.
  *
  * @param first radius of the first pass, in scene units
  * @param asked light paths per pass; at most 0: one per pixel
  */
abstract class PhotonMaps(first: Float, asked: Int, view: View) extends SharedPasses:
  import PhotonMaps.*

  private val paths = if asked > 0 then asked else Math.min(view.crop.pixels, MaxPaths).toInt
  private val shutter = view.shutter.getOrElse(Shutter(0f, 0f))
  private val recent = new Array[Pass | Null](SharedPasses.MaxOpen)

  /** The photon map of a pass; up to [[SharedPasses.MaxOpen]] passes may be in progress. None if
    * stopped before it was complete.
    */
  private[candela] def apply(
      number: Int,
      tracer: PhotonTracer,
      isStopped: () => Boolean
  ): Option[PhotonMap] =
    val pass = passAt(number)
    if pass.map.isEmpty then pass.help(tracer, shutter, isStopped)
    pass.map

  def release(pass: Int): Unit = synchronized:
    val slot = pass % recent.length
    if recent(slot) != null && recent(slot).number == pass then recent(slot) = null

  private def passAt(number: Int): Pass = synchronized:
    val slot = number % recent.length
    if recent(slot) == null || recent(slot).number != number then
      recent(slot) = Pass(number, paths, radius(number))
    recent(slot)

  private def radius(pass: Int): Float =
    var r2 = first.toDouble * first
    for k <- 1 to pass do r2 *= (k + Alpha) / (k + 1)
    Math.sqrt(r2).toFloat

private[candela] object PhotonMaps:
  private val Alpha: Double = 2.0 / 3.0
  val PartSize = 1024
  private val MaxPaths = 100_000_000L

  /** In nanoseconds; short beside a pass. */
  private val Pause = 50_000L

  private final class Pass(val number: Int, paths: Int, radius: Float):
    private val batches = new Array[Photons]((paths + PartSize - 1) / PartSize)
    private val next = AtomicInteger()
    private val done = AtomicInteger()
    @volatile private var failure: Option[Throwable] = None
    @volatile var map: Option[PhotonMap] = None

    def help(tracer: PhotonTracer, shutter: Shutter, isStopped: () => Boolean): Unit =
      try work(tracer, shutter, isStopped)
      catch
        case e: Throwable =>
          failure = Some(e)
          throw e
      while map.isEmpty && !isStopped() do
        for e <- failure do throw e
        LockSupport.parkNanos(Pause)

    private def work(tracer: PhotonTracer, shutter: Shutter, isStopped: () => Boolean): Unit =
      var batch = next.getAndIncrement()
      while batch < batches.length && !isStopped() do
        val count = Math.min(PartSize, paths - batch * PartSize)
        batches(batch) = tracer.trace(number, batch, count, shutter, isStopped)
        // Else it has a part of its paths
        if !isStopped() && done.incrementAndGet() == batches.length then
          try map = Some(PhotonMap(batches, paths, radius, tracer.draw(number), isStopped))
          catch case _: GivenUp => () // as the parts of the others
        batch = next.getAndIncrement()

/** The passes of [[PhotonMapper]].
  *
  * @param maxDepth   maximum number of scattering events of a camera subpath
  * @param interfaces what they are to light sampling
  */
final class PhotonPasses(
    scene: Scene,
    maxDepth: Int,
    settings: PhotonSettings,
    view: View,
    interfaces: Interfaces = Interfaces.Open
) extends PhotonMaps(settings.radius, settings.paths, view):

  def integrator(report: Option[PathReport]): PassIntegrator =
    PhotonMapper(report.fold(scene)(scene.reported), maxDepth, settings, this, interfaces)
