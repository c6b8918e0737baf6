package candela.api

import candela.diagnostics.Code
import candela.film.Film
import candela.render.{Live, Looks, Pass as CorePass, Progress as CoreProgress}

import java.time.Duration
import java.util.function.Consumer
import java.util.{Objects, Optional, OptionalDouble}

import scala.jdk.OptionConverters.*

/** Observes a rendering. Its methods are called in the thread that called [[Job.render]]; the image
  * doesn't depend on them. All methods are optional. If one throws, the rendering ends, and
  * [[Job.render]] throws the exception.
  */
trait RenderListener:

  /** Called before the first sample. Any thread may use `rendering` from then on. */
  def started(rendering: LiveRendering): Unit = ()

  /** Called about ten times a second, and at the end. */
  def progressed(progress: Progress): Unit = ()

  /** Whether [[passed]] is called; all workers pause meanwhile. False unless overridden. */
  def wantsPasses: Boolean = false

  /** Called after 1, 2, 4, 8, … samples per pixel, and at the end, if [[wantsPasses]] is true. */
  def passed(pass: Pass): Unit = ()

private[api] object RenderListeners:
  object Silent extends RenderListener

  def onProgress(act: Consumer[Progress]): RenderListener = new RenderListener:
    override def progressed(progress: Progress): Unit = act.accept(progress)

/** Progress of a rendering. Immutable. */
final class Progress private[api] (of: CoreProgress):
  /** Camera samples taken by this run, in all pixels. */
  def samples: Long = of.done

  /** Planned camera samples; unknown if a goal ends the rendering. */
  def planned: Long = of.total

  /** Completed fraction, in [0, 1]: of the samples. If a goal ends the rendering: of its expected
    * time, which may change; 0 until it is known.
    */
  def part: Double = of.fraction
  def elapsed: Duration = Times.of(of.seconds)

  /** Estimated time left. */
  def remaining: Optional[Duration] = of.outlook.left.map(Times.of).toJava

  /** Recent camera samples per second. */
  def samplesPerSecond: OptionalDouble = of.outlook.rate.toJavaPrimitive

  /** Root of the relative mean squared error, if it is estimated. */
  def error: OptionalDouble = of.outlook.error.toJavaPrimitive

  /** As `Progress(42.0 %, 12.0 s)`. */
  override def toString: String =
    Shown("Progress", s"${Shown.rounded(part * 100)} %", s"${Shown.rounded(of.seconds)} s")

/** A pass, after which all pixels have the same number of samples. Valid until
  * [[RenderListener.passed]] returns.
  */
final class Pass private[api] (of: CorePass, develop: () => RenderedImage):
  /** Samples per pixel. */
  def samples: Int = of.samples
  def elapsed: Duration = Times.of(of.clock)

  /** Whether it completes the rendering. */
  def isLast: Boolean = of.isLast

  /** The image so far. */
  def image: RenderedImage = develop()
  override def toString: String = Shown("Pass", Shown.perPixel(samples))

/** A rendering in progress, for observers in any thread. */
final class LiveRendering private[api] (live: Live, develop: () => RenderedImage):
  /** The image at this moment; pixels may have different numbers of samples. */
  def image: RenderedImage = develop()
  def progress: Progress = Progress(live.progress)
  override def toString: String = Shown("LiveRendering", s"$progress")

private[api] object Times:
  def of(seconds: Double): Duration = Duration.ofNanos(Math.round(seconds * 1e9))

  /** In seconds.
    *
    * @throws SceneException unless it is above 0
    */
  def positive(what: String, time: Duration): Double =
    if Objects.requireNonNull(time, what).isNegative || time.isZero then
      Problems.fail(Code.OptionValue, s"$what must be above 0, found $time")
    time.getSeconds + time.getNano * 1e-9

/** Forwards the core's events to a listener. */
private[api] final class Followed(
    to: RenderListener,
    develop: candela.render.Rendering => RenderedImage
) extends candela.render.RenderListener:
  private var live = Option.empty[Live]

  override def started(live: Live): Unit =
    this.live = Some(live)
    to.started(LiveRendering(live, () => develop(live.rendering)))
  override def progressed(progress: CoreProgress): Unit = to.progressed(Progress(progress))
  override def frequency: Looks = if to.wantsPasses then Looks.Doublings else Looks.Never
  override def passed(pass: CorePass, film: Film): Unit =
    for l <- live do to.passed(Pass(pass, () => develop(l.rendering)))
