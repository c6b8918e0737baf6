package candela.api

import candela.render.Rendering

import java.time.Duration
import java.util.{List as JList, Optional, OptionalDouble}

import scala.jdk.OptionConverters.*

/** What [[Job.render]] returns. Immutable. */
final class RenderResult private[api] (
    rendering: Rendering,
    val image: RenderedImage,
    relative: Option[Double],
    estimate: Option[RenderedImage],
    found: Vector[candela.base.Problem]
):
  /** Whether all planned samples are taken, or a goal was reached: not if it was cancelled. */
  def isComplete: Boolean = rendering.isComplete

  /** Samples that every pixel has at least, with those of earlier runs. */
  def samplesPerPixel: Int = rendering.samplesDone

  /** Of these, those of earlier runs, from a film file. */
  def earlierSamplesPerPixel: Int = rendering.earlier

  /** Camera samples taken, in all pixels. */
  def samples: Long = rendering.samplesTaken

  /** Rays of all kinds that were traced. */
  def rays: Long = rendering.rays

  /** Time of rendering, without that of preparing. */
  def duration: Duration = Times.of(rendering.seconds)

  /** Samples that were left out as they had no finite value. */
  def discarded: Long = rendering.refused.fold(0L)(_.count)

  /** Estimated error of the image, the root of the relative mean squared error: 0.01 is 1 %. Known
    * from 2 samples per pixel on, if [[RenderControl.withErrorEstimates]] or a goal asks for it.
    */
  def error: OptionalDouble = relative.toJavaPrimitive

  /** Estimated standard error of each value of the colours, likewise. */
  def errors: Optional[RenderedImage] = estimate.toJava

  /** Problems of rendering, such as a film file that could not be written. */
  def problems: JList[Problem] = Problems.ofCore(found)

/** A fault of Candela's in a sample, or a lack of memory. */
final class RenderException private[api] (val x: Int, val y: Int, val sample: Int, cause: Throwable)
    extends RuntimeException(s"at pixel ($x, $y), sample $sample: $cause", cause)
