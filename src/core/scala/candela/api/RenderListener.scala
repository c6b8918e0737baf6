package candela.api

import candela.film.Film
import candela.render.{Live, Looks, Pass as CorePass, Progress as CoreProgress}

import java.time.Duration
import java.util.function.Consumer
import java.util.{Optional, OptionalDouble}

import scala.jdk.OptionConverters.*

/** Follows a rendering. It is called in the thread that renders, never in two at once; the image
  * does not depend on it. Each method may be left out. What it throws ends the rendering, and is
  * thrown by [[Job.render]].
  */
trait RenderListener:

  /** Called before the first sample. Any thread may look at `rendering` from then on. */
  def started(rendering: LiveRendering): Unit = ()

  /** Called about ten times a second, and at the end. */
  def progressed(progress: Progress): Unit = ()

  /** Whether [[passed]] is called; all workers pause meanwhile. */
  def wantsPasses: Boolean = false

  /** Called after 1, 2, 4, 8, … samples per pixel, and at the end, when all pixels have equally
    * many.
    */
  def passed(pass: Pass): Unit = ()

private[api] object RenderListeners:
  object Silent extends RenderListener

  def onProgress(act: Consumer[Progress]): RenderListener = new RenderListener:
    override def progressed(progress: Progress): Unit = act.accept(progress)

/** How far a rendering is. Immutable. */
final class Progress private[api] (of: CoreProgress):
  /** Camera samples taken by this run, in all pixels. */
  def samples: Long = of.done

  /** Camera samples to take; not known beforehand if a goal ends the rendering. */
  def planned: Long = of.total

  /** How much is done, in [0, 1]; of a rendering that a goal ends, of its time. */
  def part: Double = of.part
  def elapsed: Duration = Times.of(of.seconds)

  /** Until the end, as far as can be told. */
  def remaining: Optional[Duration] = of.outlook.left.map(Times.of).toJava

  /** Camera samples per second, of late. */
  def samplesPerSecond: OptionalDouble = of.outlook.rate.toJavaPrimitive

  /** Root of the relative mean squared error, if it is estimated. */
  def error: OptionalDouble = of.outlook.error.toJavaPrimitive

/** A part of a rendering after which all pixels have the same number of samples. Valid until
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

/** A rendering in progress, for observers in any thread. Looking at it costs the workers nothing.
  */
final class LiveRendering private[api] (live: Live, develop: () => RenderedImage):
  /** The image at this moment; pixels may have different numbers of samples. */
  def image: RenderedImage = develop()
  def progress: Progress = Progress(live.progress)

private[api] object Times:
  def of(seconds: Double): Duration = Duration.ofNanos(Math.round(seconds * 1e9))

/** What the core tells a listener. */
private[api] final class Followed(
    to: RenderListener,
    develop: candela.render.Rendering => RenderedImage
) extends candela.render.RenderListener:
  private var live = Option.empty[Live]

  override def started(live: Live): Unit =
    this.live = Some(live)
    to.started(LiveRendering(live, () => develop(live.rendering)))
  override def progressed(progress: CoreProgress): Unit = to.progressed(Progress(progress))
  override def looks: Looks = if to.wantsPasses then Looks.Doublings else Looks.Never
  override def passed(pass: CorePass, film: Film): Unit =
    for l <- live do to.passed(Pass(pass, () => develop(l.rendering)))
