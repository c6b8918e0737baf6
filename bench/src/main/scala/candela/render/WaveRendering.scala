package candela.render

import candela.cameras.CameraRays
import candela.color.Rgb
import candela.film.{Film, Fireflies, SampleLimit, SharedPass}
import candela.integrators.{PathTracer, PathWave}

import java.lang.management.ManagementFactory

/** A rendering on one thread: by [[TileWorker]], or by waves of paths ([[PathWave]]) as soon as they
  * are compiled and faster. The film is the same to the bit.
  *
  * @param waveSamples samples per pixel of a tile that are a wave
  */
final class WaveRendering(plan: RenderPlan, waveSamples: Int):
  import WaveRendering.*

  private val job = Job(plan, Shard.Whole)
  private val schedule = job.schedule.asInstanceOf[TileSchedule]
  private val samples = plan.samplesPerPixel

  /** Why waves cannot render this, if so. */
  def obstacle: Option[String] = tracer(plan) match
    case None => Some("no path tracer over surfaces")
    case Some(of) =>
      val no = Seq(
        plan.layers.isDefined -> "layers",
        plan.bands.isDefined -> "bands of wavelengths",
        plan.camera.weighs -> "a camera that weighs",
        !plan.sharesSamples -> "samples of one pixel",
        plan.shutter.isDefined -> "motion",
        (plan.fireflies != Fireflies.Kept) -> "fireflies",
        of.scene.hasInterfaces -> "interfaces",
        of.scene.isDispersive -> "dispersion",
        of.scene.hasSubsurface -> "subsurface scattering"
      )
      no.collectFirst { case (true, what) => what }

  /** Of the waves, once they have begun. */
  var worker: Option[WaveWorker] = None

  /** Renders by Candela's own workers. */
  def scalar(passed: Int => Unit): Film =
    runScalar(passed, () => false): Unit
    job.film

  /** Renders by workers until waves are ready, and then by waves.
    *
    * @param passed is told the samples per pixel done; negative or zero: waves take over after as
    *               many
    */
  def waves(passed: Int => Unit, atOnce: Boolean): Film =
    val waves = WaveWorker(plan, job.film, schedule, waveSamples)
    worker = Some(waves)
    val done =
      if atOnce then 0
      else
        val warmUp = WaveWarmUp(plan, waveSamples)
        val begun = runScalar(passed, () => warmUp.isReady(scalarRate))
        warmUp.stop()
        begun
    passed(-done)
    var sample = done
    while sample < samples do
      val end = Math.min(samples, sample + waveSamples)
      for tile <- schedule.tiles.indices do waves.take(tile, sample, end)
      sample = end
      passed(sample)
    job.film

  private var scalarNanos, scalarPaths = 0L
  private def scalarRate: Double = scalarNanos.toDouble / Math.max(1L, scalarPaths)

  /** Takes samples until there are all, or others can go on; returns how many. */
  private def runScalar(passed: Int => Unit, isOver: () => Boolean): Int =
    val queue = TaskQueue(schedule, Cancellation())
    val worker = job.worker(queue)
    var done = 0
    while done < samples && !isOver() do
      val wave = schedule.waveOf(done)
      val before = threadNanos()
      queue.openUntil(wave + 1, done + 1)
      queue.begin(1)
      worker.run()
      done += 1
      scalarNanos = threadNanos() - before
      scalarPaths = plan.sampled.pixels
      passed(done)
    done

object WaveRendering:
  def threadNanos(): Long = ManagementFactory.getThreadMXBean.getCurrentThreadCpuTime

  private[render] def tracer(plan: RenderPlan): Option[PathTracer] = plan.method match
    case RenderMethod.Tiles(integrators) =>
      integrators.make(None) match
        case of: PathTracer => Some(of)
        case _ => None
    case _ => None

/** Has waves compiled: a thread of its own takes samples that nobody wants, until these cost less
  * processor time than the renderer's.
  */
private final class WaveWarmUp(plan: RenderPlan, waveSamples: Int):
  private val perPath = java.util.concurrent.atomic.AtomicLong(Long.MaxValue)
  @volatile private var isStopped = false
  private val thread = Thread(() => run(), "waves")
  thread.setDaemon(true)
  thread.start()

  /** @param scalar nanoseconds of a path by the renderer's own workers */
  def isReady(scalar: Double): Boolean = perPath.get * 1.1 < scalar

  def stop(): Unit = isStopped = true

  private def run(): Unit =
    val job = Job(plan, Shard.Whole)
    val schedule = job.schedule.asInstanceOf[TileSchedule]
    val worker = WaveWorker(plan, job.film, schedule, waveSamples)
    val random = java.util.SplittableRandom(1)
    while !isStopped do
      val before = WaveRendering.threadNanos()
      val many = 8
      for _ <- 0 until many do
        worker.take(random.nextInt(schedule.tiles.length), 0, waveSamples)
      val nanos = WaveRendering.threadNanos() - before
      perPath.set(nanos / (many * waveSamples * TileSchedule.TileSize * TileSchedule.TileSize))

/** Takes samples of tiles by waves; what [[TileWorker]] does for the plans that waves render. */
final class WaveWorker private[render] (
    plan: RenderPlan,
    film: Film,
    schedule: TileSchedule,
    waveSamples: Int
):
  private val pixels = TileSchedule.TileSize * TileSchedule.TileSize
  private val most = waveSamples * pixels
  private val sampler = plan.sampler.copy()
  private val rays = CameraRays(plan.camera, plan.shutter, plan.differentialScale)
  private val limit: SampleLimit | Null = plan.limit.orNull
  private val shared: SharedPass = film.shares.get.pass()
  private val own = WaveRendering.tracer(plan).get
  val wave: PathWave =
    PathWave(own.scene, own.limits, sampler, rays.ray, most, WaveRendering.threadNanos)
  private val filmX, filmY = new Array[Float](most)
  private val states = new Array[Byte](most)

  /** Nanoseconds of camera rays, and of the film. */
  var cameraNanos, filmNanos: Long = 0L

  /** Paths so far. */
  var paths: Long = 0L

  def take(tile: Int, from: Int, until: Int): Unit =
    val t0 = WaveRendering.threadNanos()
    val box = schedule.tiles(tile)
    val count = box.pixels.toInt
    shared.begin(tile)
    for sample <- from until until do
      var i = 0
      while i < count do
        begin((sample - from) * count + i, box.x0 + i % box.width, box.y0 + i / box.width, sample)
        i += 1
    val t1 = WaveRendering.threadNanos()
    wave.follow()
    val t2 = WaveRendering.threadNanos()
    for sample <- from until until do
      var i = 0
      while i < count do
        record((sample - from) * count + i)
        i += 1
      shared.end()
    paths += count * (until - from)
    cameraNanos += t1 - t0
    filmNanos += WaveRendering.threadNanos() - t2

  private def begin(number: Int, x: Int, y: Int, sample: Int): Unit =
    val px = Math.floorMod(x, plan.width)
    val py = Math.floorMod(y, plan.height)
    sampler.start(px, py, sample)
    sampler.next2D()
    val fx = x + sampler.x
    val fy = y + sampler.y
    filmX(number) = fx
    filmY(number) = fy
    states(number) = 0
    if shared.reaches(fx, fy) then
      if rays.next(fx, fy, sampler) == 0f then states(number) = 1
      else
        states(number) = 2
        wave.begin(number, px, py, sample)

  private def record(number: Int): Unit =
    if states(number) != 0 then
      val found =
        if states(number) == 1 then Rgb.Black
        else
          plan.basis.toSrgb(Rgb(wave.red(number), wave.green(number), wave.blue(number)))
      val light = if limit != null then found * limit.scale(found) else found
      if light.isFinite then shared.add(filmX(number), filmY(number), light.r, light.g, light.b)
