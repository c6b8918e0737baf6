package candela.api

import candela.render.Rendering

import java.time.Duration
import java.util.{List as JList, Optional, OptionalDouble}

import scala.jdk.OptionConverters.*

/** Result of [[Job.render]]. Immutable. */
final class RenderResult private[api] (
    rendering: Rendering,
    val image: RenderedImage,
    relative: Option[Double],
    estimate: Option[RenderedImage],
    found: Vector[candela.diagnostics.Problem]
):
  /** Whether all planned samples were taken, or a goal was reached; false if cancelled, or if time
    * was out before every pixel had a sample.
    */
  def isComplete: Boolean = rendering.isComplete

  /** Minimum samples per pixel, including earlier runs. */
  def samplesPerPixel: Int = rendering.samplesDone

  /** Samples per pixel of earlier runs, from a film file. */
  def earlierSamplesPerPixel: Int = rendering.earlier

  /** Camera samples taken, in all pixels. */
  def samples: Long = rendering.samplesTaken

  /** Traced rays of all kinds. */
  def rays: Long = rendering.rays

  /** Rendering time, without preparation. */
  def duration: Duration = Times.of(rendering.seconds)

  /** Samples discarded because their value was not finite. */
  def discarded: Long = rendering.discarded.fold(0L)(_.count)

  /** Estimated error of the image, the root of the relative mean squared error: 0.01 is 1 %.
    * Present from 8 samples per pixel on, with [[RenderControl.withErrorEstimates]] or a goal; of a
    * film that is complete already, if it was estimated then.
    */
  def error: OptionalDouble = relative.toJavaPrimitive

  /** Estimated standard error of each colour value, likewise, but from 2 samples per pixel on;
    * empty if a film was complete already.
    */
  def errors: Optional[RenderedImage] = estimate.toJava

  /** Problems of rendering, such as a film file that could not be written. */
  def problems: JList[Problem] = Problems.ofCore(found)

  /** As `RenderResult(640x360, 16 samples per pixel, 12.3 s)`. */
  override def toString: String =
    val size = s"${image.width}x${image.height}"
    val state = if isComplete then "" else "incomplete"
    val seconds = s"${Shown.rounded(rendering.seconds)} s"
    Shown("RenderResult", size, Shown.perPixel(samplesPerPixel), seconds, state)

/** A bug in Candela, or a lack of memory. */
final class RenderException private[api] (val x: Int, val y: Int, val sample: Int, cause: Throwable)
    extends RuntimeException(s"at pixel ($x, $y), sample $sample: $cause", cause)
