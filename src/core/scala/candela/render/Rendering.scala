package candela.render

import candela.concurrency.Parallel
import candela.aov.LayerFilm
import candela.film.{Development, Film}
import candela.guiding.GuideOutcome
import candela.image.Image

/** Progress of a rendering.
  *
  * @param done    camera samples taken, or found to be needless, of `total`
  * @param seconds elapsed time
  * @param isOver  whether all is done
  */
final case class Progress(
    done: Long,
    total: Long,
    seconds: Double,
    outlook: Outlook = Outlook(),
    isOver: Boolean = false
):
  /** How much of the rendering is done, in [0, 1]; of one that a goal ends, of its expected time,
    * if that is known.
    */
  def knownFraction: Option[Double] =
    val ofSamples = if total == 0 then 1 else done.toDouble / total
    if isOver then Some(1)
    else if !outlook.hasGoal then Some(ofSamples)
    else outlook.left.map(l => Math.max(ofSamples, seconds / Math.max(seconds + l, 1e-9)))

  /** Likewise; 0 if it is unknown. */
  def fraction: Double = knownFraction.getOrElse(0)

/** What is known about the rest of a rendering.
  *
  * @param left    seconds until it ends, if that is known
  * @param rate    camera samples per second, over the last half of them
  * @param error   relative error so far, if somebody observes it
  * @param hasGoal whether something else than the number of its samples may end it
  * @param samples per pixel at which its goal ends it, if that is known
  */
final case class Outlook(
    left: Option[Double] = None,
    rate: Option[Double] = None,
    error: Option[Double] = None,
    hasGoal: Boolean = false,
    samples: Option[SampleRange] = None
)

/** Requests a rendering to stop soon and return the partial image. Thread-safe.
  *
  * @param others whose requests are requests of this one
  */
final class Cancellation(others: Cancellation*):
  @volatile private var requested = false
  def request(): Unit = requested = true
  def isRequested: Boolean = requested || others.exists(_.isRequested)

/** NaN or infinite camera samples, discarded from the image.
  *
  * @param x        pixel of the first one, with `y`: lowest sample number, then lowest row
  * @param material index of the last material that its path hit; −1: unknown
  */
final case class DiscardedSamples(count: Long, x: Int, y: Int, sample: Int, material: Int = -1)

private[render] object DiscardedSamples:
  /** The first, with the count of all. */
  def of(all: Vector[DiscardedSamples]): Option[DiscardedSamples] =
    all.minByOption(r => (r.sample, r.y, r.x)).map(_.copy(count = all.map(_.count).sum))

/** Result of a rendering.
  *
  * @param samplesPerPixel planned samples per pixel
  * @param samplesDone     samples that every pixel has at least; fewer than planned if cancelled
  * @param samplesTaken    camera samples in all pixels
  * @param rays            traced rays of all kinds
  * @param discarded       discarded samples, if any
  * @param layers          requested AOVs, if any
  * @param learned         what its paths learnt, if they did
  * @param learning        of the seconds, those that workers did nothing but learn
  * @param earlier         of the samples done, those of earlier runs that it continues
  * @param samplesSpared   planned samples in all pixels that these did without
  */
final case class Rendering(
    film: Film,
    samplesPerPixel: Int,
    samplesDone: Int,
    samplesTaken: Long,
    rays: Long,
    seconds: Double,
    discarded: Option[DiscardedSamples],
    layers: Option[LayerFilm] = None,
    learned: Option[GuideOutcome] = None,
    learning: Double = 0,
    earlier: Int = 0,
    samplesSpared: Long = 0
):
  /** Share of the samples done that are taken, the others being spared. */
  def takenShare: Double =
    if samplesSpared == 0 then 1 else samplesTaken.toDouble / (samplesTaken + samplesSpared)

  /** Colour channels, then AOVs, then wavelength bands.
    *
    * @param pool develops the colours
    */
  def image(development: Development, pool: Parallel = Parallel.Alone): Image =
    image(development, development(film, pool = pool))

  /** Likewise, if the colours are developed. */
  def image(development: Development, colors: Image): Image =
    val layered = layers.fold(colors)(_.appendTo(colors, development, film.splats))
    development.bands.fold(layered): bands =>
      film.bands.fold(bands.appendTo(layered, film.toImage(1f)))(_.appendTo(layered, film.splats))

  def isComplete: Boolean = samplesDone >= samplesPerPixel

  /** Whether no number of samples was to end it. */
  def isOpenEnded: Boolean = samplesPerPixel == RenderPlan.Endless

/** An internal error in one sample: `cause`, with its pixel and sample number. */
final class RenderFailure(val x: Int, val y: Int, val sample: Int, cause: Throwable)
    extends RuntimeException(s"at pixel ($x, $y), sample $sample: $cause", cause)
