package candela.render

import candela.film.{Development, Film, LayerFilm}
import candela.guiding.GuideOutcome
import candela.image.Image

/** Progress of a rendering.
  *
  * @param done    camera samples taken, of `total`
  * @param seconds elapsed time
  */
final case class Progress(done: Long, total: Long, seconds: Double)

/** Requests a rendering to stop soon and return the partial image. Thread-safe. */
final class Cancellation:
  @volatile private var requested = false
  def request(): Unit = requested = true
  def isRequested: Boolean = requested

/** NaN or infinite camera samples, discarded from the image.
  *
  * @param x        pixel of the first one, with `y`: lowest sample number, then lowest row
  * @param material index of the last material that its path hit; −1: unknown
  */
final case class Refused(count: Long, x: Int, y: Int, sample: Int, material: Int = -1)

private[render] object Refused:
  /** The first, with the count of all. */
  def of(all: Vector[Refused]): Option[Refused] =
    all.minByOption(r => (r.sample, r.y, r.x)).map(_.copy(count = all.map(_.count).sum))

/** Result of a rendering.
  *
  * @param samplesPerPixel planned samples per pixel
  * @param samplesDone     samples that every pixel has at least; fewer than planned if cancelled
  * @param samplesTaken    camera samples in all pixels
  * @param rays            traced rays of all kinds
  * @param refused         discarded samples, if any
  * @param layers          requested AOVs, if any
  * @param learned         what its paths learnt, if they did
  */
final case class Rendering(
    film: Film,
    samplesPerPixel: Int,
    samplesDone: Int,
    samplesTaken: Long,
    rays: Long,
    seconds: Double,
    refused: Option[Refused],
    layers: Option[LayerFilm] = None,
    learned: Option[GuideOutcome] = None
):
  /** Colour channels, then AOVs, then wavelength bands. */
  def image(development: Development): Image = image(development, development(film))

  /** Likewise, if the colours are developed. */
  def image(development: Development, colors: Image): Image =
    val layered = layers.fold(colors)(_.behind(colors, development))
    development.bands.fold(layered): bands =>
      film.bands.fold(bands.behind(layered, film.toImage(1f)))(_.behind(layered))

  def isComplete: Boolean = samplesDone == samplesPerPixel

/** An internal error in one sample: `cause`, with its pixel and sample number. */
final class RenderFailure(val x: Int, val y: Int, val sample: Int, cause: Throwable)
    extends RuntimeException(s"at pixel ($x, $y), sample $sample: $cause", cause)

/** A part of a rendering after which all pixels have the same number of samples.
  *
  * @param samples samples per pixel so far
  * @param begin   seconds since the start of rendering, without the observer's time
  * @param workers busy time of each worker, in seconds
  * @param isLast  whether it completes the rendering
  * @param next    samples per pixel of the next part
  */
final case class Pass(
    samples: Int,
    begin: Double,
    end: Double,
    workers: Vector[Double],
    isLast: Boolean = false,
    next: Int = 0
)

/** An image observer, called after 1, 2, 4, 8, … samples per pixel, and at the end.
  *
  * All workers pause for it, and its time is excluded, so that measurements don't slow down what
  * they measure. The pause between passes is its only cost.
  */
abstract class PassObserver:

  /** Called in the caller's thread; no sample is added meanwhile. Not called for a cancelled pass.
    */
  def passed(pass: Pass, film: Film): Unit

  /** Called before the first pass.
    *
    * @param samples samples per pixel of an earlier rendering that is continued
    */
  def begins(samples: Int, film: Film): Unit = ()

  /** Whether the image is good enough: the rendering then ends. */
  def isEnough: Boolean = false

  /** Asked about ten times a second: whether the rendering is to end at once, though not all pixels
    * have the same number of samples.
    *
    * @param seconds since the start of rendering, without the observer's time
    * @param still   seconds since a worker last got on with its work
    */
  def isOver(seconds: Double, still: Double): Boolean = false

  /** Whether it is also called in between, after each part of which every pixel gets equally many
    * samples, up to 64.
    */
  def seesWaves: Boolean = false
