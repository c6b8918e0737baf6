package candela.watch

import candela.film.PixelBounds
import candela.image.Image
import candela.measure.{BatchVariance, CurvePoint, Errors}
import candela.render.{Background, Live, Progress, Rendering, RenderPlan}

import java.lang.management.ManagementFactory

/** Takes snapshots of a rendering in a background thread, without disturbing its workers, and
  * measures its error.
  *
  * Takes a snapshot when the samples have become half as many again, for the error curve, and as
  * often as its share of the machine allows while `isWatched`.
  *
  * @param reference if defined, errors are measured against it, otherwise estimated
  * @param threads   of the rendering
  * @param isWatched whether anyone looks at the snapshots
  */
final class Observer(
    plan: RenderPlan,
    reference: Option[Image],
    threads: Int,
    live: Live,
    isWatched: () => Boolean
) extends AutoCloseable:
  import Observer.*

  private val variance = BatchVariance(plan.crop.pixels.toInt, 3)

  // Changed only by the observer's thread, or after its end
  private var seenSamples, measuredSamples, nextNanos = 0L
  private var noise: Option[Image] = None
  @volatile private var latest: Option[Snapshot] = None
  @volatile private var curve = Vector.empty[CurvePoint]
  @volatile private var result: Option[(Rendering, Progress)] = None

  private val repeated = Background.repeat("observer", TickMillis)(() => tick())

  /** The most recent snapshot, if there is one. */
  def snapshot: Option[Snapshot] = latest

  /** The error curve so far. */
  def points: Vector[CurvePoint] = curve

  /** The rendering so far; the result, once it has ended. */
  def rendering: Rendering = result.fold(live.rendering)(_._1)

  def progress: Progress = result.fold(live.progress)(_._2)

  def isEnded: Boolean = result.isDefined

  /** Whether the rendering goes on beyond the planned samples; None: it can't, or has ended. */
  def keepsOn: Option[Boolean] = Option.when(live.canKeepOn && !isEnded)(live.keepsOn)

  def keepOn(wanted: Boolean): Unit = live.keepOn(wanted)

  /** The tiles that are being rendered. */
  def tiles: Vector[PixelBounds] = if isEnded then Vector.empty else live.tiles

  /** Takes the last snapshot, of the result. */
  def end(rendering: Rendering): Unit =
    repeated.close()
    observe(rendering, measures = rendering.samplesTaken > measuredSamples)
    result = Some((rendering, live.progress.copy(seconds = rendering.seconds)))

  def close(): Unit = repeated.close()

  private def tick(): Unit =
    if System.nanoTime >= nextNanos then
      val began = processorNanos
      val rendering = live.rendering
      val samples = rendering.samplesTaken
      val measures = rendering.samplesDone > 0 && samples >= Growth * measuredSamples
      val watched = isWatched()
      if samples > seenSamples && (measures || watched) then observe(rendering, measures)
      // The first ones cost most, as the JVM still interprets them, and viewers await them most.
      val longest =
        if watched && latest.forall(_.version < Early) then EarlyPause else LongestPause
      val pause = ((processorNanos - began) / (Share * threads)).toLong
      nextNanos = System.nanoTime + Math.min(longest, pause)

  private def observe(rendering: Rendering, measures: Boolean): Unit =
    seenSamples = rendering.samplesTaken
    val weights = Option.when(measures)(new Array[Float](plan.crop.pixels.toInt))
    val colors = plan.development(rendering.film, weights)
    weights.foreach(measure(rendering, colors, _))
    val image = rendering.image(plan.development, colors)
    latest = Some(Snapshot(latest.fold(1)(_.version + 1), image, noise))

  private def measure(state: Rendering, colors: Image, weights: Array[Float]): Unit =
    measuredSamples = state.samplesTaken
    variance.add(colors, weights)
    noise = Option.when(variance.isKnown)(variance.noise(colors.channelNames, colors.width))
    val errors = reference match
      case Some(r) => Some(Errors.quickly(r)(colors))
      case None => Option.when(variance.isKnown)(variance.errors(colors))
    val average = Math.round(state.samplesTaken.toDouble / plan.sampled.pixels).toInt
    val samples = Math.max(state.samplesDone, average)
    errors.foreach(e => curve :+= CurvePoint(samples, state.seconds, e))

object Observer:
  /** Milliseconds between two looks at the rendering. */
  private val TickMillis = 100L

  /** Share of the processors' time that snapshots may take. */
  private val Share = 0.005

  /** Number of snapshots after which they are no longer early. */
  private val Early = 6

  // In nanoseconds
  private val EarlyPause = 400_000_000L
  private val LongestPause = 10_000_000_000L

  private val threadTimes = ManagementFactory.getThreadMXBean

  /** Processor time of this thread; other threads of the machine may hold it up. */
  private def processorNanos: Long =
    if threadTimes.isCurrentThreadCpuTimeSupported then threadTimes.getCurrentThreadCpuTime
    else System.nanoTime

  /** Growth of the number of samples between two points of the error curve. */
  private val Growth = 1.4
